Scene = scene(); m = material::red_plastic(); m.Color(vec3(0, 1, 0)).Metallic(0.5).Smoothness(0.75);
Scene.Add(sphere(vec3(0), 1, m)); Scene.Render();
//& shapes.0.material.base_color = (0, 1, 0)
//& shapes.0.material.metallic = 0.5
//& shapes.0.material.roughness = 0.25
