//@ frames 2
Scene = scene(); f = function() { #Scene.Render(); return 5; }; print(f() + f());   //= 10
