Scene = scene(); Scene.Add(sphere(vec3(0), 1).Move(vec3(1, 0, 0)).Scale(2)); Scene.Render();
//& shapes.0.transform = (2, 0, 0, 2, 0, 2, 0, 0, 0, 0, 2, 0)
