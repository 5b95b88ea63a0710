Scene = scene(); s = sphere(vec3(0), 1); Scene.Add(s); Scene.Add(s); Scene.Render();
//& shapes.count = 1
