//@ frames 1
Scene = scene(); f = function() { #Scene.Render(); return [1, 2]; }; for (x in f()) print(x);
//= 1
//= 2
