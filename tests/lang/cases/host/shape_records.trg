Scene = scene(); Scene.Add(tor(vec3(0, 0.75, 1), 0.75, 5)); Scene.Render();
//& shapes.0.kind = "tor"
//& shapes.0.parameters = ((0, 0.75, 1), 0.75, 5)
