/*
 * arrange - lists of places: ring, row, grid, spiral, scatter.
 *
 * Each function returns a list of points for a loop. All start round the origin on y = 0; add a vector
 * to shift a place. Lengths are metres, angles degrees.
 *
 *   arrange::ring(count = 8, radius = 5)               a circle round Y, from +X towards +Z
 *   arrange::row(count, from, to)                      a line, both ends included
 *   arrange::grid(columns = 5, rows = 5, step = 1)     along X, then Z; its middle is the origin
 *   arrange::block(columns, layers, rows, step = 1)    a grid of three dimensions, standing on y = 0
 *   arrange::spiral(count = 40, radius = 5, turns = 3, rise = 0)    from the middle outwards; rise is the
 *                                                      height of the last place
 *   arrange::helix(count = 40, radius = 5, turns = 3, height = 5)   the radius stays
 *   arrange::sunflower(count = 100, step = 1)          equally dense over a disc, as seeds are
 *   arrange::scatter(count, low, high, seed = 1, gap = 0)    by chance in a box; places nearer than gap to
 *                                                      another are left out, so there may be fewer
 *   arrange::heading(place)                            degrees about Y that turn +Z away from the origin
 *
 * Use:
 *
 *   include("stl/arrange.trg");
 *   Scene = scene();
 *   for (place in arrange::ring(12, 5))
 *       Scene.Add(sphere(place + vec3(0, 0.5, 0), 0.5, material::gold()));
 *   for (place in arrange::scatter(200, vec3(-4, 0, -4), vec3(4, 0, 4), 7, 0.5))
 *       Scene.Add(conus(place, 0.15, 0.6, material::green_plastic()));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(0, 7, 11), vec3(0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/random.trg");

arrange::ring = function(count = 8 ~ "num", radius = 5 ~ "num")
{
    places = [];
    for (k = 0; k < count; k++)
        places.append(arrange::polar(radius, 360 * k / count));
    return places;
};

arrange::row = function(count ~ "num", from ~ "vec3", to ~ "vec3")
{
    places = [];
    for (k = 0; k < count; k++)
        places.append(mth::mix(from, to, k / mth::max(1, count - 1)));
    return places;
};

arrange::grid = function(columns = 5 ~ "num", rows = 5 ~ "num", step = 1 ~ "num")
{
    return arrange::block(columns, 1, rows, step);
};

arrange::block = function(columns = 5 ~ "num", layers = 5 ~ "num", rows = 5 ~ "num", step = 1 ~ "num")
{
    places = [];
    for (y = 0; y < layers; y++)
        for (z = 0; z < rows; z++)
            for (x = 0; x < columns; x++)
                places.append(vec3(x - (columns - 1) / 2, y, z - (rows - 1) / 2) * step);
    return places;
};

arrange::spiral = function(count = 40 ~ "num", radius = 5 ~ "num", turns = 3 ~ "num", rise = 0 ~ "num")
{
    places = [];
    for (k = 0; k < count; k++)
    {
        t = k / mth::max(1, count - 1);
        places.append(arrange::polar(radius * t, 360 * turns * t) + vec3(0, rise * t, 0));
    }
    return places;
};

arrange::helix = function(count = 40 ~ "num", radius = 5 ~ "num", turns = 3 ~ "num", height = 5 ~ "num")
{
    places = [];
    for (k = 0; k < count; k++)
    {
        t = k / mth::max(1, count - 1);
        places.append(arrange::polar(radius, 360 * turns * t) + vec3(0, height * t, 0));
    }
    return places;
};

/* Each place a golden angle on, its distance as the root of its number (H. Vogel, "A better way to
   construct the sunflower head", Mathematical Biosciences 44, 1979). */
arrange::sunflower = function(count = 100 ~ "num", step = 1 ~ "num")
{
    places = [];
    for (k = 0; k < count; k++)
        places.append(arrange::polar(step * mth::sqrt(k), 137.50776405 * k));
    return places;
};

/* A place too near to another is drawn anew, up to 20 times. */
arrange::scatter = function(count ~ "num", low = vec3(-5, 0, -5) ~ "vec3", high = vec3(5, 0, 5) ~ "vec3",
    seed = 1 ~ "num", gap = 0 ~ "num")
{
    dice = random::make(seed);
    places = [];
    for (k = 0; k < count; k++)
    {
        place = dice.Point(low, high);
        for (tries = 1; tries < 20 && arrange::is_near(place, places, gap); tries++)
            place = dice.Point(low, high);
        if (!arrange::is_near(place, places, gap))
            places.append(place);
    }
    return places;
};

arrange::is_near = function(place ~ "vec3", others ~ "list", gap ~ "num")
{
    if (gap <= 0) return 0;
    for (other in others)
        if (mth::length(other - place) < gap) return 1;
    return 0;
};

arrange::heading = function(place ~ "vec3")
{
    return mth::Radian2Degree(mth::atan2(place.x, place.z));
};

/* The point at a distance from the Y axis; 0 degrees is +X, 90 is +Z. */
arrange::polar = function(radius ~ "num", degrees ~ "num")
{
    angle = mth::Degree2Radian(degrees);
    return vec3(radius * mth::cos(angle), 0, radius * mth::sin(angle));
};
