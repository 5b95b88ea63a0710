/* Springs that carry balls: each swings a little later than its neighbour. One spring is wound and
   copied; copies are squeezed by Scale. Written with stl/shapes/spring.trg. */
include("stl/shapes/spring.trg");
include("stl/materials.trg");
include("stl/arrange.trg");

Scene = scene();
Scene.Background(vec3(0.7, 0.75, 0.85));
Scene.Add(plane(vec3(0, 1, 0), 0, materials::ceramic(vec3(0.45, 0.43, 0.4))));
wound = shapes::spring(6, 0.55, 2, 0.07, materials::brushed(materials::nickel(), 0.75));
colours = [vec3(0.7, 0.03, 0.02), vec3(0.8, 0.25, 0.01), vec3(0.75, 0.6, 0.02), vec3(0.05, 0.4, 0.08),
    vec3(0.02, 0.3, 0.5), vec3(0.03, 0.06, 0.5), vec3(0.25, 0.03, 0.4)];
count = len(colours);

swings = [];
for (place in arrange::row(count, vec3(-5.4, 0, 0), vec3(5.4, 0, 0)))
{
    swing = object();
    swing.height = 1;
    swing.foot = place;
    swing.coil = wound.Copy().Move(place).AddTo(Scene);
    swing.ball = Scene.Add(sphere(place + vec3(0, 2.55, 0), 0.55, materials::lacquer(colours[len(swings)])));
    swings.append(swing);
}

Scene.Add(dir_light(vec3(-3, 6, 5), vec3(1.2, 1.15, 1.05)));
Scene.Add(area_light(vec3(6, 8, 6), vec3(-5, -6, -6), 5, 5, vec3(2, 2, 2.2)));
for (frame = 0; frame < 48; frame++)
{
    for (k = 0; k < count; k++)
    {
        swing = swings[k];
        height = 1 + 0.4 * mth::sin(2 * mth::PI * (frame / 48 - k / count));
        swing.coil.Scale(vec3(1, height / swing.height, 1));
        swing.ball.Move(vec3(0, 2 * (height - swing.height), 0));
        swing.height = height;
    }
    Scene.CamSet(960, 540, vec3(0, 4.5, 15), vec3(0, 1.6, 0), vec3(0, 1, 0), 28);
    Scene.Render();
}
