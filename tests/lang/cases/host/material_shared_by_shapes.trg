Scene = scene(); m = material::gold(); Scene.Add(sphere(vec3(0), 1, m)); Scene.Add(sphere(vec3(3), 1, m));
Scene.Render(); m.Color(vec3(1, 0, 0)); Scene.Render();
//& shapes.0.material.base_color = (1, 0, 0)
//& shapes.1.material.base_color = (1, 0, 0)
