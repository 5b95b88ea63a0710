//@ frames 1
Scene = scene(); f = function(n) { if (n == 0) { #Scene.Render(); return 0; } return 1 + #f(n - 1); };
print(f(199));   //= 199
