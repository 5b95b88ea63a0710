//@ frames 1
Scene = scene(); f = function() { #Scene.Render(); return 2; }; l = [5, 6, 7]; print(l[f()]);   //= 7
