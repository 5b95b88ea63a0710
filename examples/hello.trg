/* A gold ball in a red ring: the smallest scene with everything in it. */
Scene = scene();
Scene.Background(vec3(0.6, 0.42, 0.22));
Scene.Add(plane(vec3(0, 1, 0), 0, material::pearl()));
Scene.Add(sphere(vec3(0, 1, 0), 1, material::gold()));
Scene.Add(tor(vec3(0, 0.25, 0), 0.25, 1.6, material::red_plastic()));
Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 0.95, 0.85)));
Scene.CamSet(640, 360, vec3(2, 2.5, 5), vec3(0, 0.7, 0), vec3(0, 1, 0), 33);
Scene.Render();
