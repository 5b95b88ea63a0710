Scene = scene(); Scene.CamSet(1, 16384, vec3(1), vec3(0), vec3(0, 1, 0), 179); Scene.Render();
//& camera.width = 1
//& camera.height = 16384
