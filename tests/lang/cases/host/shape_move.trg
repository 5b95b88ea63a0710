Scene = scene(); Scene.Add(sphere(vec3(0), 1).Move(vec3(1, 2, 3))); Scene.Render();
//& shapes.0.transform = (1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3)
