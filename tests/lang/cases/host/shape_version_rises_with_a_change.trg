Scene = scene(); s = Scene.Add(sphere(vec3(0), 1)); Scene.Render(); Scene.Render(); s.Move(vec3(1)); Scene.Render();
//& shapes.0.version = 2
