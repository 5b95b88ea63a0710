//@ frames 4
Scene = scene(); f = function(n) { if (n == 0) return; #Scene.Render(); #f(n - 1); }; f(4);
