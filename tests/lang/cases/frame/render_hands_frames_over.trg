//@ frames 3
Scene = scene(); for (i = 0; i < 3; i++) { Scene.Render(); } print("end");   //= end
