/*
 * gear - a spur gear with straight-sided teeth.
 *
 * Lengths are metres. The axis is Y; the gear lies on y = 0. Two gears of one module mesh when their
 * axes are module * (teeth1 + teeth2) / 2 apart; they turn against each other as teeth2 : teeth1.
 *
 *   shapes::gear(teeth = 16, module = 0.25, thickness = 0.4, mtl, hub)
 *       teeth        their number, at least 6
 *       module       pitch diameter / teeth: how large one tooth is
 *       mtl, hub     materials of the wheel, and of its hub and bolts
 *   shapes::pitch_radius(teeth, module)      where the gears of a pair touch
 *   shapes::meshed(teeth1, turn1, teeth2, heading = 0)
 *       how many degrees to turn the second gear about Y so that it fits the first, which is turned by
 *       turn1; heading is the direction to the second: 0 is +X, 90 is -Z
 *   A gear is a group (stl/group.trg). A tooth is centred on +X.
 *
 * Use:
 *
 *   include("stl/shapes/gear.trg");
 *   Scene = scene();
 *   large = shapes::gear(24, 0.2);
 *   large.AddTo(Scene);
 *   small = shapes::gear(12, 0.2, 0.4, material::copper());
 *   small.Rotate(vec3(0, 1, 0), shapes::meshed(24, 0, 12));
 *   small.Move(vec3(0.2 * (24 + 12) / 2, 0, 0)).AddTo(Scene);
 *   Scene.Background(vec3(0.8, 0.85, 0.9));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(1, 7, 5), vec3(1, 0, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/group.trg");

shapes::pitch_radius = function(teeth ~ "num", module ~ "num")
{
    return teeth * module / 2;
};

/* Counted in teeth from the line between the axes, the two phases make a tooth on a gap: half a tooth. */
shapes::meshed = function(teeth1 ~ "num", turn1 ~ "num", teeth2 ~ "num", heading = 0 ~ "num")
{
    phase = (heading - turn1) * teeth1 / 360;
    return heading + 180 - (0.5 - phase) * 360 / teeth2;
};

shapes::gear = function(teeth = 16 ~ "num", module = 0.25 ~ "num", thickness = 0.4 ~ "num",
    mtl = material::brass() ~ "material", hub = material::black_plastic() ~ "material")
{
    teeth = mth::max(6, mth::floor(teeth));
    pitch = shapes::pitch_radius(teeth, module);
    root = pitch - 1.25 * module;
    whole = group::make();
    whole.Put(cylinder(vec3(0), root, thickness, mtl));
    whole.Put(cylinder(vec3(0, thickness, 0), root * 0.3, thickness * 0.3, hub));
    bolt = cylinder(vec3(root * 0.65, thickness, 0), root * 0.06, thickness * 0.15, hub);
    for (k = 0; k < 6; k++)
        whole.Put(bolt.Copy().Rotate(vec3(0, 1, 0), k * 60));

    tooth = shapes::gear_tooth(pitch, module, thickness, mtl);
    for (k = 0; k < teeth; k++)
    {
        for (part in tooth.parts)
            whole.Put(part.Copy().Rotate(vec3(0, 1, 0), 360 / teeth * k));
    }
    return whole;
};

/*
 * One tooth on +X: a block whose width falls from root to tip as a basic rack's does, with flanks at
 * 20 degrees. At the pitch circle tooth and gap are as wide as each other but for 4 % of play. It is a
 * little thinner than the wheel, so that their faces do not lie in one plane.
 */
shapes::gear_tooth = function(pitch ~ "num", module ~ "num", thickness ~ "num", mtl ~ "material")
{
    middle = 0.96 * module * mth::PI / 4;
    slope = mth::tan(mth::Degree2Radian(20));
    inner = pitch - 1.5 * module;
    outer = pitch + module;
    wide = middle + slope * 1.5 * module;
    narrow = middle - slope * module;
    low = thickness * 0.01;
    high = thickness * 0.99;

    /* a to d run round the lower face, e to h round the upper one. */
    a = vec3(inner, low, -wide);
    b = vec3(outer, low, -narrow);
    c = vec3(outer, low, narrow);
    d = vec3(inner, low, wide);
    e = vec3(inner, high, -wide);
    f = vec3(outer, high, -narrow);
    g = vec3(outer, high, narrow);
    h = vec3(inner, high, wide);
    whole = group::make();
    shapes::quad(whole, e, h, g, f, mtl);
    shapes::quad(whole, a, b, c, d, mtl);
    shapes::quad(whole, b, f, g, c, mtl);
    shapes::quad(whole, a, e, f, b, mtl);
    shapes::quad(whole, d, c, g, h, mtl);
    return whole;
};

/* Two triangles; the corners run counter-clockwise, seen from outside. */
shapes::quad = function(whole ~ "object", a ~ "vec3", b ~ "vec3", c ~ "vec3", d ~ "vec3", mtl ~ "material")
{
    whole.Put(triangle(a, b, c, mtl));
    whole.Put(triangle(a, c, d, mtl));
};
