Scene = scene(); Scene.Add(sphere(vec3(1, 0, 0), 1).Rotate(vec3(0, 1, 0), 90)); Scene.Render();
//& shapes.0.transform = (0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0)
