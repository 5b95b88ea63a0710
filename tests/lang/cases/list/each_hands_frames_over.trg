//@ frames 3
Scene = scene(); for (x in [1, 2, 3]) { Scene.Render(); print(x); }
//= 1
//= 2
//= 3
