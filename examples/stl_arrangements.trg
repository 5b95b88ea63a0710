/* Arrangements: ring, grid, spiral, helix, sunflower and scatter, each on its own tray. Written with
   stl/arrange.trg. */
include("stl/arrange.trg");
include("stl/materials.trg");

Scene = scene();
Scene.Background(vec3(0.8, 0.78, 0.75));
Scene.Add(plane(vec3(0, 1, 0), 0, materials::ceramic(vec3(0.4, 0.4, 0.42))));
paper = material::pbr(vec3(0.75, 0.73, 0.68), 0, 0.4);

/* A ball of the size given at each place, on a tray. */
Show = function(tray ~ "vec3", places ~ "list", size ~ "num", mtl ~ "material")
{
    #Scene.Add(cylinder(tray, 2.9, 0.15, #paper));
    for (place in places)
        #Scene.Add(sphere(tray + place + vec3(0, 0.15 + size, 0), size, mtl));
};

trays = arrange::grid(3, 2, 6.4);
Show(trays[0], arrange::ring(14, 2.2), 0.4, materials::lacquer(vec3(0.6, 0.02, 0.02)));
Show(trays[1], arrange::grid(6, 6, 0.72), 0.3, materials::lacquer(vec3(0.7, 0.35, 0.01)));
Show(trays[2], arrange::spiral(48, 2.5, 3), 0.16, materials::lacquer(vec3(0.02, 0.3, 0.06)));
Show(trays[3], arrange::helix(60, 1.5, 4, 3), 0.18, materials::lacquer(vec3(0.02, 0.2, 0.5)));
Show(trays[4], arrange::sunflower(190, 0.185), 0.12, materials::lacquer(vec3(0.85, 0.6, 0.02)));
Show(trays[5], arrange::scatter(40, vec3(-1.8, 0, -1.8), vec3(1.8, 0, 1.8), 4, 0.36), 0.18,
    materials::lacquer(vec3(0.3, 0.03, 0.4)));

Scene.Add(dir_light(vec3(-4, 7, 3), vec3(1.2, 1.15, 1.05)));
Scene.CamSet(960, 540, vec3(0, 17, 18), vec3(0, 0.6, 0.4), vec3(0, 1, 0), 28.5);
Scene.Render();
