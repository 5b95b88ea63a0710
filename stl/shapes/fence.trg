/*
 * fence - a ring of panels with a round post at each corner.
 *
 * The built-in fence() makes the panels; this adds posts with balls on top. Lengths are metres.
 *
 *   shapes::fence(radius = 5, height = 1.2, count = 8, panel, post)
 *       radius   from the Y axis to the middle of a panel
 *       height   of the panels; the posts are a little taller
 *       count    of panels, at least 3
 *       panel, post      materials
 *   Returns a group (stl/group.trg) that stands on y = 0. The first panel is on +Z.
 *
 * Use:
 *
 *   include("stl/shapes/fence.trg");
 *   Scene = scene();
 *   shapes::fence(4, 1, 7, material::blue_plastic(), material::brass()).AddTo(Scene);
 *   Scene.Add(sphere(vec3(0, 1.5, 0), 1.5, material::pearl()));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::green_rubber()));
 *   Scene.Background(vec3(0.8, 0.85, 0.9));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(0, 5, 10), vec3(0, 0.8, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/group.trg");

shapes::fence = function(radius = 5 ~ "num", height = 1.2 ~ "num", count = 8 ~ "num",
    panel = material::white_plastic() ~ "material",
    post = material::bronze() ~ "material")
{
    whole = group::make();
    whole.Put(fence(vec3(0, height / 2, 0), radius, height, count, panel));

    /* Two panels meet half a step beside the middle of each. */
    half = mth::PI / mth::floor(count);
    corner = radius / mth::cos(half);
    pole = cylinder(vec3(0), height * 0.08, height * 1.1, post);
    ball = sphere(vec3(0, height * 1.18, 0), height * 0.12, post);
    for (k = 0; k < mth::floor(count); k++)
    {
        angle = half * (2 * k + 1);
        place = vec3(mth::sin(angle), 0, mth::cos(angle)) * corner;
        whole.Put(pole.Copy().Move(place));
        whole.Put(ball.Copy().Move(place));
    }
    return whole;
};
