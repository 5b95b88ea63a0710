/* Lights: a point, a spot and a glowing ball, in a room that is dark otherwise. */
Scene = scene();
Scene.Background(vec3(0.01, 0.01, 0.02));
Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
Scene.Add(box(vec3(-6, 0, -4), vec3(6, 5, -3.8), material::white_rubber()));

for (i = 0; i < 5; i++)
    Scene.Add(cylinder(vec3(i * 2 - 4, 0, -1), 0.4, 1 + i / 2, material::pearl()));

/* Place, colour; then the paper's fall-off 1 / (cc + cl d + cq d^2). */
Scene.Add(point_light(vec3(-4, 3, 1), vec3(2.5, 0.9, 0.5), 1, 0.01, 0.05));

/* Place, direction, inner and outer cone angle in degrees, colour. */
Scene.Add(spot_light(vec3(0, 5, 4), vec3(0, -0.8, -1), 20, 35, vec3(60, 60, 54)));

Scene.Add(sphere(vec3(4, 0.6, 1.5), 0.6, material::emission(vec3(0.2, 0.5, 1), 8)));

Scene.CamSet(960, 540, vec3(0, 3, 9), vec3(0, 1.4, -1), vec3(0, 1, 0));
Scene.Render();
