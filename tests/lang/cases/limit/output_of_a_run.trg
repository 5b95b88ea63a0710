//@ limit output_lines = 2
Scene = scene(); for (i = 0; i < 5; i++) { print(i); Scene.Render(); }
//= 0
//= 1
//= output cut
