Scene = scene(); Scene.Add(sphere(vec3(0), 1)); Scene.Render(); Scene.Add(sphere(vec3(3), 1)); Scene.Render();
//& shapes.count = 2
//& frame = 2
