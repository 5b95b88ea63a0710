/* Materials: a row of the library's, a row made by hand. Each call of material:: gives a fresh copy. */
Scene = scene();
Scene.Background(vec3(0.75, 0.7, 0.65));
Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));

Row = function(z ~ "num", m1 ~ "material", m2 ~ "material", m3 ~ "material", m4 ~ "material", m5 ~ "material")
{
    #Scene.Add(#sphere(#vec3(-5, 1, z), 1, m1));
    #Scene.Add(#sphere(#vec3(-2.5, 1, z), 1, m2));
    #Scene.Add(#sphere(#vec3(0, 1, z), 1, m3));
    #Scene.Add(#sphere(#vec3(2.5, 1, z), 1, m4));
    #Scene.Add(#sphere(#vec3(5, 1, z), 1, m5));
};

Row(-3, material::polished_gold(), material::copper(), material::chrome(), material::jade(),
    material::black_rubber());

/* pbr takes colour, metallic, smoothness. */
lacquer = material::pbr(vec3(0.02, 0.1, 0.5), 0, 0.9);
steel = material::silver();
steel.Smoothness(0.55);
Row(0, material::glass(1.5), material::mirror(), lacquer, steel,
    material::emission(vec3(1, 0.6, 0.2), 3));

Scene.Add(dir_light(vec3(-4, 7, 6), vec3(1, 1, 1)));
Scene.CamSet(960, 540, vec3(0, 4.5, 9), vec3(0, 0.5, -1), vec3(0, 1, 0), 44);
Scene.Render();
