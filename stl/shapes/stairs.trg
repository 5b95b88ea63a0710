/*
 * stairs - a straight flight, and a spiral one round a column.
 *
 * Lengths are metres, angles degrees. Both return a group (stl/group.trg) that stands on y = 0; the top
 * step lies at steps * rise.
 *
 *   shapes::stairs(steps = 10, width = 1.5, rise = 0.18, run = 0.28, mtl)
 *       climbs along -Z from z = 0, as wide along X; rise and run are of one step
 *   shapes::spiral_stairs(steps = 16, radius = 1.5, rise = 0.2, degrees = 22.5, mtl)
 *       climbs round Y, from +X towards -Z; degrees is the turn from one step to the next
 *
 * Use:
 *
 *   include("stl/shapes/stairs.trg");
 *   Scene = scene();
 *   shapes::stairs(12, 2).Rotate(vec3(0, 1, 0), -30).Move(vec3(-2, 0, 2)).AddTo(Scene);
 *   shapes::spiral_stairs(18, 1.4, 0.18, 20, material::copper()).Move(vec3(1.5, 0, 0)).AddTo(Scene);
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(-1, 4, 9), vec3(-0.5, 1.7, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/group.trg");
include("stl/shapes/rod.trg");

shapes::stairs = function(steps = 10 ~ "num", width = 1.5 ~ "num", rise = 0.18 ~ "num",
    run = 0.28 ~ "num", mtl = material::white_plastic() ~ "material")
{
    whole = group::make();
    for (k = 0; k < steps; k++)
        whole.Put(box(vec3(-width / 2, 0, -k * run), vec3(width / 2, (k + 1) * rise, -(k + 1) * run), mtl));
    return whole;
};

shapes::spiral_stairs = function(steps = 16 ~ "num", radius = 1.5 ~ "num", rise = 0.2 ~ "num",
    degrees = 22.5 ~ "num", mtl = material::pewter() ~ "material")
{
    whole = group::make();
    rail_height = 0.9;
    whole.Put(cylinder(vec3(0), radius * 0.1, steps * rise + rail_height, mtl));

    /* A tread as wide as the way from step to step at the rim, and a fifth over. */
    wide = radius * mth::Degree2Radian(degrees) * 1.2;
    tread = box(vec3(0, -0.25 * rise, -wide / 2), vec3(radius, 0, wide / 2), mtl);
    post = cylinder(vec3(radius * 0.95, 0, 0), radius * 0.015, rail_height, mtl);
    for (k = 0; k < steps; k++)
    {
        place = vec3(0, (k + 1) * rise, 0);
        whole.Put(tread.Copy().Rotate(vec3(0, 1, 0), k * degrees).Move(place));
        whole.Put(post.Copy().Rotate(vec3(0, 1, 0), k * degrees).Move(place));
    }

    /* The rail runs over the tops of the posts, in pieces a third of a step long. */
    pieces = 3 * (steps - 1);
    ball = sphere(vec3(0), radius * 0.03, mtl);
    for (k = 0; k <= pieces; k++)
    {
        angle = -mth::Degree2Radian(k / 3 * degrees);
        here = vec3(radius * 0.95 * mth::cos(angle), (k / 3 + 1) * rise + rail_height,
            radius * 0.95 * mth::sin(angle));
        whole.Put(ball.Copy().Move(here));
        if (k > 0)
            whole.Put(shapes::rod(last, here, radius * 0.03, mtl));
        last = here;
    }
    return whole;
};
