//@ limit max_steps = 5000
//@ frames 10
Scene = scene(); for (k = 0; k < 10; k++) { for (i = 0; i < 3000; i++) { } Scene.Render(); } print("end");   //= end
