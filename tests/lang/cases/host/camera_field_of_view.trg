Scene = scene(); Scene.CamSet(640, 360, vec3(0, 1, 5), vec3(0), vec3(0, 1, 0)); Scene.Render();
//& camera.width = 640
//& camera.fov_degrees = 53.13010235415598
//& camera.location = (0, 1, 5)
