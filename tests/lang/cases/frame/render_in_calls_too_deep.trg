//@ frames 0
Scene = scene(); f = function(n) { if (n == 0) { #Scene.Render(); } #f(n - 1); };   //! E607@22: 'f'
f(200);
