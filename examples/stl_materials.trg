/* The material library: the thirty rows of its table from front left to back right, and behind them
   a row of finishes. Written with stl/materials.trg and stl/arrange.trg. */
include("stl/materials.trg");
include("stl/arrange.trg");

Scene = scene();
Scene.Background(vec3(0.32, 0.34, 0.38));
Scene.Add(plane(vec3(0, 1, 0), 0, materials::ceramic(vec3(0.3, 0.31, 0.33))));

finishes = [materials::water(), materials::diamond(), materials::frosted_glass(), materials::tinted_glass(),
    materials::tinted_mirror(), materials::titanium(), materials::brushed(material::polished_gold(), 0.55),
    materials::lacquer(), materials::clay(), materials::lamp(2700, 3)];

n = 0;
for (place in arrange::grid(10, 4, 2.5))
{
    if (n < 30) mtl = materials::teapot(n);
    else mtl = finishes[n - 30];
    Scene.Add(sphere(vec3(place.x, 1, -place.z), 1, mtl));
    n++;
}

/* Two soft lamps as in a studio, and a little sun. */
Scene.Add(area_light(vec3(-9, 9, 7), vec3(9, -8, -7), 7, 7, vec3(4, 3.8, 3.5)));
Scene.Add(area_light(vec3(12, 8, -2), vec3(-12, -7, 2), 4, 8, vec3(2.5, 2.8, 3.2)));
Scene.Add(dir_light(vec3(-3, 7, 5), vec3(0.6, 0.58, 0.55)));
Scene.CamSet(960, 380, vec3(0, 14, 26), vec3(0, 0.4, 0), vec3(0, 1, 0), 22.1);
Scene.Render();
