//@ frames 1
Scene = scene(); f = function(g) { g(); return 1; }; print(f(function() { #Scene.Render(); }));   //= 1
