/*
 * spring - a wire wound round the Y axis.
 *
 * Lengths are metres. The wire is made of short rods with a ball at each joint; all rods share one mesh,
 * and so do the balls.
 *
 *   shapes::spring(turns = 6, radius = 0.5, height = 2, wire = 0.06, mtl)
 *       turns    how often it goes round; need not be whole
 *       radius   from the axis to the middle of the wire
 *       height   from the lowest to the highest point
 *       wire     radius of the wire
 *   Returns a group (stl/group.trg). It begins on +X, lies on y = 0 and goes round towards +Z.
 *
 * Use:
 *
 *   include("stl/shapes/spring.trg");
 *   Scene = scene();
 *   shapes::spring(6, 0.5, 2).Move(vec3(-1.5, 0, 0)).AddTo(Scene);
 *   shapes::spring(6, 0.5, 1, 0.06, material::copper()).AddTo(Scene);
 *   shapes::spring(3, 0.8, 2, 0.15, material::red_plastic()).Move(vec3(2, 0, 0)).AddTo(Scene);
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(0.5, 2.5, 6), vec3(0.5, 0.9, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/group.trg");
include("stl/shapes/rod.trg");

shapes::spring = function(turns = 6 ~ "num", radius = 0.5 ~ "num", height = 2 ~ "num",
    wire = 0.06 ~ "num", mtl = material::chrome() ~ "material")
{
    pieces = mth::max(1, mth::ceil(turns * 36));
    first = shapes::spring_point(0, turns, radius, height, wire);
    step = shapes::spring_point(1 / pieces, turns, radius, height, wire) - first;
    piece = cylinder(vec3(0), wire, mth::length(step), mtl);
    ball = sphere(vec3(0), wire, mtl);

    whole = group::make();
    whole.Put(ball.Copy().Move(first));
    here = first;
    for (k = 1; k <= pieces; k++)
    {
        next = shapes::spring_point(k / pieces, turns, radius, height, wire);
        whole.Put(shapes::aim(piece.Copy(), next - here).Move(here));
        whole.Put(ball.Copy().Move(next));
        here = next;
    }
    return whole;
};

/* The middle of the wire at t = 0 (bottom) to 1 (top). */
shapes::spring_point = function(t ~ "num", turns ~ "num", radius ~ "num", height ~ "num", wire ~ "num")
{
    angle = t * turns * 2 * mth::PI;
    return vec3(radius * mth::cos(angle), wire + t * (height - 2 * wire), radius * mth::sin(angle));
};
