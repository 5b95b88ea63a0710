Scene = scene(); Scene.Add(dir_light(vec3(0, 1, 0), vec3(1))); Scene.Render();
//& lights.count = 1
//& lights.0.direction = (0, 1, 0)
