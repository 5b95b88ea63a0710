//@ limit output_lines_frame = 1
Scene = scene(); print("a"); print("b"); Scene.Render(); print("c");
//= a
//= output cut
//= c
