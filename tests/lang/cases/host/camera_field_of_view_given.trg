Scene = scene(); Scene.CamSet(64, 36, vec3(0, 1, 5), vec3(0), vec3(0, 1, 0), 40); Scene.Render();
//& camera.fov_degrees = 40
