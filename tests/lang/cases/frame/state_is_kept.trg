Scene = scene(); n = 0; while (n < 3) { n++; Scene.Render(); print(n); }
//= 1
//= 2
//= 3
