/*
 * cameras - where to stand and where to look, for stills and for rides.
 *
 * A view is an object with three fields for Scene.CamSet: loc, at, up. The functions make one for a
 * moment t: 0 is the start of the ride, 1 its end. Lengths are metres, angles degrees.
 *
 *   cameras::look(loc, at)                          a view that stands still
 *   cameras::orbit(t, at, radius = 10, height = 5)  once round the point at; the view at 1 is that at 0
 *   cameras::dolly(t, from, to, at)                 straight on rails; looks at a point
 *   cameras::track(t, from, to, at)                 straight on rails; keeps the direction it starts with
 *   cameras::path(t, points, at, closed = 0)        smoothly through a list of points; looks at a point
 *   cameras::fly(t, points, closed = 0)             the same; looks where it goes
 *   cameras::along(t, points, closed = 0)           the place on that way: a curve through the points
 *   cameras::ease(t)                                t, starting and stopping gently
 *   cameras::shoot(Scene, view, width = 640, height = 360, fov = 53.13)    sets the scene's camera
 *
 * Use:
 *
 *   include("stl/cameras.trg");
 *   Scene = scene();
 *   Scene.Add(box(vec3(-1, 0, -1), vec3(1, 2, 1), material::red_plastic()));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   for (k = 0; k < 48; k++)
 *   {
 *       cameras::shoot(Scene, cameras::orbit(k / 48, vec3(0, 1, 0), 6, 3));
 *       Scene.Render();
 *   }
 */

cameras::look = function(loc ~ "vec3", at = vec3(0) ~ "vec3")
{
    view.loc = loc;
    view.at = at;
    view.up = vec3(0, 1, 0);
    return view;
};

cameras::shoot = function(Scene ~ "scene", view ~ "object", width = 640 ~ "num", height = 360 ~ "num",
    fov = 53.13010235415598 ~ "num")
{
    return Scene.CamSet(width, height, view.loc, view.at, view.up, fov);
};

/* Starts on +Z and goes on towards +X; height is counted from the point looked at. */
cameras::orbit = function(t ~ "num", at = vec3(0) ~ "vec3", radius = 10 ~ "num", height = 5 ~ "num")
{
    angle = t % 1 * 2 * mth::PI;
    return cameras::look(at + vec3(radius * mth::sin(angle), height, radius * mth::cos(angle)), at);
};

cameras::dolly = function(t ~ "num", from ~ "vec3", to ~ "vec3", at = vec3(0) ~ "vec3")
{
    return cameras::look(mth::mix(from, to, t), at);
};

cameras::track = function(t ~ "num", from ~ "vec3", to ~ "vec3", at = vec3(0) ~ "vec3")
{
    return cameras::look(mth::mix(from, to, t), at + (to - from) * t);
};

cameras::ease = function(t ~ "num")
{
    t = mth::clamp(t, 0, 1);
    return t * t * (3 - 2 * t);
};

cameras::path = function(t ~ "num", points ~ "list", at = vec3(0) ~ "vec3", closed = 0 ~ "num")
{
    return cameras::look(cameras::along(t, points, closed), at);
};

/* The direction is that of a short chord round t, so it turns without a jerk at the points. */
cameras::fly = function(t ~ "num", points ~ "list", closed = 0 ~ "num")
{
    here = cameras::along(t, points, closed);
    ahead = cameras::along(t + 0.005, points, closed) - cameras::along(t - 0.005, points, closed);
    return cameras::look(here, here + mth::normalize(ahead));
};

/*
 * Catmull-Rom spline: a cubic between each two points, whose slope at a point is half the step from the
 * one before to the one behind (E. Catmull and R. Rom, "A class of local interpolating splines", 1974).
 * An open way is straight before its start and behind its end; a closed one returns to its first point.
 */
cameras::along = function(t ~ "num", points ~ "list", closed = 0 ~ "num")
{
    count = len(points);
    spans = count - 1;
    if (closed) spans = count;
    place = t * spans;
    if (closed) place = place % spans;
    from = mth::clamp(mth::floor(place), 0, spans - 1);
    u = place - from;
    before = cameras::point(points, from - 1, closed);
    start = cameras::point(points, from, closed);
    end = cameras::point(points, from + 1, closed);
    behind = cameras::point(points, from + 2, closed);
    if (u < 0) return start + (end - before) * (u / 2);
    if (u > 1) return end + (behind - start) * ((u - 1) / 2);
    return start + ((end - before) * u + (before * 2 - start * 5 + end * 4 - behind) * (u * u)
        + (start * 3 - before - end * 3 + behind) * (u * u * u)) / 2;
};

/* Beyond the ends of an open way the last step goes on. */
cameras::point = function(points ~ "list", n ~ "num", closed ~ "num")
{
    last = len(points) - 1;
    if (closed) return points[n % (last + 1)];
    if (n < 0) return points[0] * 2 - points[1];
    if (n > last) return points[last] * 2 - points[last - 1];
    return points[n];
};
