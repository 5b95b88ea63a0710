/*
 * rod - a cylinder between two points.
 *
 * cylinder() and conus() stand along +Y. These two functions point them anywhere. Lengths are metres.
 *
 *   shapes::rod(from, to, radius = 0.1, mtl)    a cylinder; from and to must differ
 *   shapes::aim(thing, direction)               turns a shape or group built along +Y to the direction
 *
 * Use:
 *
 *   include("stl/shapes/rod.trg");
 *   Scene = scene();
 *   top = vec3(0, 3, 0);
 *   for (k = 0; k < 3; k++)
 *       Scene.Add(shapes::rod(vec3(mth::cos(k * 2.1), 0, mth::sin(k * 2.1)), top, 0.08));
 *   arrow = conus(vec3(0), 0.3, 1, material::red_plastic());
 *   Scene.Add(shapes::aim(arrow, vec3(1, 1, 0)).Move(top));
 *   Scene.CamSet(640, 360, vec3(2, 3, 7), vec3(0, 1.8, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */

shapes::rod = function(from ~ "vec3", to ~ "vec3", radius = 0.1 ~ "num",
    mtl = material::silver() ~ "material")
{
    bar = cylinder(vec3(0), radius, mth::length(to - from), mtl);
    return shapes::aim(bar, to - from).Move(from);
};

/* The axis of the turn is square to both: up x direction. Straight up and down it has no length. */
shapes::aim = function(thing, direction ~ "vec3")
{
    up = vec3(0, 1, 0);
    axis = mth::cross(up, mth::normalize(direction));
    if (mth::length(axis) < 1e-9)
        axis = vec3(1, 0, 0);
    turn = mth::acos(mth::clamp(mth::dot(up, mth::normalize(direction)), -1, 1));
    return thing.Rotate(axis, mth::Radian2Degree(turn));
};
