//@ frames 12
Scene = scene(); while (1) { Scene.Render(); }
