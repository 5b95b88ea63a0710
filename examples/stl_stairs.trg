/* Stairs: a spiral one and two straight flights lead to a gallery. Written with stl/shapes/stairs.trg. */
include("stl/shapes/stairs.trg");
include("stl/materials.trg");

Scene = scene();
Scene.Background(vec3(0.75, 0.72, 0.68));
plaster = materials::clay(vec3(0.75, 0.68, 0.58));
oak = material::pbr(vec3(0.32, 0.16, 0.07), 0, 0.6);
Scene.Add(plane(vec3(0, 1, 0), 0, material::pbr(vec3(0.42, 0.38, 0.34), 0, 0.65)));

/* The gallery: a floor of oak on three pillars, 3.24 m up. */
Scene.Add(box(vec3(-5, 3.04, -5), vec3(5, 3.24, -2.6), oak));
for (x = -4.6; x <= 4.6; x += 4.6)
    Scene.Add(cylinder(vec3(x, 0, -3.4), 0.22, 3.04, plaster));
Scene.Add(box(vec3(-14, 0, -5.4), vec3(14, 9, -5), plaster));

up = vec3(0, 1, 0);
shapes::spiral_stairs(18, 1.5, 0.18, 20, material::copper()).Rotate(up, -160).Move(vec3(2.2, 0, -1.1)).AddTo(Scene);
shapes::stairs(9, 1.6, 0.18, 0.3, oak).Move(vec3(-3, 0, 2.8)).AddTo(Scene);
shapes::stairs(9, 1.6, 0.18, 0.3, oak).Move(vec3(-3, 1.62, 0.1)).AddTo(Scene);
Scene.Add(box(vec3(-3.8, 0, -2.6), vec3(-2.2, 1.62, 0.1), plaster));

Scene.Add(dir_light(vec3(-4, 7, 6), vec3(1.6, 1.45, 1.25)));
Scene.CamSet(960, 540, vec3(1.5, 3.6, 11), vec3(-0.2, 2, -1), vec3(0, 1, 0), 33);
Scene.Render();
