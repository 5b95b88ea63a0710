//@ frames 6
Scene = scene(); f = function(n) { #Scene.Render(); return n; };
for (i = f(0); i < f(2); i += f(1)) { } print(i);   //= 2
