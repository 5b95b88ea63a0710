/*
 * trg_raytrace - what a scene needs besides shapes: lights, cameras, arrangements.
 *
 * The built-in names (sphere, material::gold, mth::sin, ...) need no include. This file adds
 * functions in the space stl::. Lengths are metres, angles degrees, colours linear 0..1.
 *
 *   stl::orbit(t, radius, height)      point on a circle round the Y axis; t = 0..1 is one turn
 *   stl::daylight(Scene)               a warm sun and a pale sky
 *   stl::ring(Scene, make, count, radius)      make(place, number) for count places on a circle
 *   stl::row(Scene, make, count, from, to)     the same along a line, both ends included
 *   stl::stage(Scene, material)        a floor at y = 0
 *
 * Use:
 *
 *   include("stl/rt/trg_raytrace.trg");
 *   Scene = scene();
 *   stl::daylight(Scene);
 *   stl::stage(Scene, material::white_plastic());
 *   stl::ring(Scene, function(p, n) { return sphere(p + vec3(0, 1, 0), 1, material::gold()); }, 8, 5);
 *   for (f = 0; f < 48; f++)
 *   {
 *       Scene.CamSet(640, 360, stl::orbit(f / 48, 14, 6), vec3(0, 1, 0), vec3(0, 1, 0));
 *       Scene.Render();
 *   }
 */

stl::orbit = function(t ~ "num", radius = 10 ~ "num", height = 5 ~ "num")
{
    angle = t * 2 * mth::PI;
    return vec3(radius * mth::cos(angle), height, radius * mth::sin(angle));
};

stl::daylight = function(Scene ~ "scene")
{
    Scene.Background(vec3(0.55, 0.7, 0.9));
    return Scene.Add(dir_light(vec3(-2, 5, 3), vec3(1, 0.96, 0.9)));
};

stl::stage = function(Scene ~ "scene", mtl ~ "material")
{
    return Scene.Add(plane(vec3(0, 1, 0), 0, mtl));
};

stl::ring = function(Scene ~ "scene", make ~ "function", count ~ "num", radius ~ "num")
{
    for (n = 0; n < count; n++)
        Scene.Add(make(stl::orbit(n / count, radius, 0), n));
};

stl::row = function(Scene ~ "scene", make ~ "function", count ~ "num", from ~ "vec3", to ~ "vec3")
{
    for (n = 0; n < count; n++)
    {
        t = 0;
        if (count > 1) t = n / (count - 1);
        Scene.Add(make(mth::mix(from, to, t), n));
    }
};
