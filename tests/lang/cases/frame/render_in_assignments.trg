//@ frames 4
Scene = scene(); f = function() { #Scene.Render(); return 2; }; x = f(); x += f(); o.n = f(); o.n *= f();
print(x, o.n);   //= 4 4
