Scene = scene(); Scene.Add(point_light(vec3(0), vec3(1))); Scene.Render();
//& lights.0.falloff = (0, 0, 1)
