Scene = scene(); std::setrndmode("CUDA"); std::setaccel("grid"); std::setaa("jittering", 4); Scene.Render();
//& modes.device = "cuda"
//& modes.accel = "grid"
//& modes.antialiasing = "jittering"
//& modes.antialiasing_n = 4
