/* A train of gears of one module: whoever is turned turns all. Each frame the first goes on by two
   degrees. Written with stl/shapes/gear.trg. */
include("stl/shapes/gear.trg");

Scene = scene();
Scene.Background(vec3(0.5, 0.47, 0.45));
Scene.Add(plane(vec3(0, 0, 1), -0.1, material::pbr(vec3(0.06, 0.09, 0.13), 0, 0.55)));

module = 0.22;
facing = vec3(1, 0, 0);
axis = vec3(0, 0, 1);
gears = [];

/* Puts a gear beside another one, upright; heading is the direction: 0 is right, 90 is up. */
Beside = function(other ~ "object", heading ~ "num", teeth ~ "num", mtl ~ "material")
{
    apart = #module * (other.teeth + teeth) / 2;
    angle = mth::Degree2Radian(heading);
    place = other.place + vec3(mth::cos(angle), mth::sin(angle), 0) * apart;
    turn = shapes::meshed(other.teeth, other.turn, teeth, heading);
    return #Gear(place, turn, -other.speed * other.teeth / teeth, teeth, mtl);
};

Gear = function(place ~ "vec3", turn ~ "num", speed ~ "num", teeth ~ "num", mtl ~ "material")
{
    made.place = place;
    made.turn = turn;
    made.speed = speed;
    made.teeth = teeth;
    made.wheel = shapes::gear(teeth, #module, 0.5, mtl);
    made.wheel.Rotate(vec3(0, 1, 0), turn).Rotate(#facing, 90).Move(place).AddTo(#Scene);
    #gears.append(made);
    return made;
};

first = Gear(vec3(-1.2, 0, 0), 0, 2, 24, material::brass());
second = Beside(first, 25, 12, material::copper());
third = Beside(second, -20, 20, material::silver());
Beside(first, 145, 16, material::copper());
Beside(first, -120, 10, material::polished_silver());
Beside(third, -110, 14, material::brass());

Scene.Add(area_light(vec3(-6, 6, 8), vec3(6, -6, -8), 6, 6, vec3(5, 4.6, 4)));
Scene.Add(area_light(vec3(8, 1, 5), vec3(-8, 0, -5), 2, 8, vec3(2, 2.3, 2.8)));
Scene.Add(dir_light(vec3(-2, 4, 6), vec3(0.7, 0.67, 0.6)));
for (frame = 0; frame < 180; frame++)
{
    Scene.CamSet(960, 540, vec3(1.5, -3, 14), vec3(0.6, -0.5, 0), vec3(0, 1, 0), 38.5);
    Scene.Render();
    for (gear in gears)
        gear.wheel.Move(-gear.place).Rotate(axis, gear.speed).Move(gear.place);
}
