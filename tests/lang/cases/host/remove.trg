Scene = scene(); s = Scene.Add(sphere(vec3(0), 1)); Scene.Remove(s); Scene.Remove(s); Scene.Render();
//& shapes.count = 0
