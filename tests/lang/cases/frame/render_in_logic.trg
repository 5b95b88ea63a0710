//@ frames 2
Scene = scene(); f = function() { #Scene.Render(); return 1; }; print(f() && f(), 0 && f(), 1 || f());   //= 1 0 1
