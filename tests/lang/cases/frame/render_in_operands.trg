//@ frames 3
Scene = scene(); f = function(n) { #Scene.Render(); return n; }; print(f(2) + f(3) * f(4));   //= 14
