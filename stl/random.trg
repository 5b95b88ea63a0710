/*
 * random - random numbers with a seed of their own.
 *
 * mth::rand() is one row of numbers for the whole program. These are as many rows as wanted, each the
 * same in every run and on every machine, and none disturbs another.
 *
 *   random::make(seed = 1)       a generator; seeds are whole numbers from 1 on
 *   r.Next(low = 0, high = 1)    the next number, low <= number < high
 *   r.Point(low, high)           a point in the box between two corners
 *
 * Use:
 *
 *   include("stl/random.trg");
 *   Scene = scene();
 *   dice = random::make(7);
 *   for (k = 0; k < 40; k++)
 *       Scene.Add(sphere(dice.Point(vec3(-4, 0.2, -4), vec3(4, 3, 4)), 0.2, material::gold()));
 *   print("a throw:", mth::floor(dice.Next(1, 7)));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.CamSet(640, 360, vec3(0, 4, 12), vec3(0, 1, 0), vec3(0, 1, 0));
 *   Scene.Render();
 *
 * The generator is the "minimal standard" of S. K. Park and K. W. Miller, "Random number generators:
 * good ones are hard to find", Communications of the ACM 31 (10), 1988. Its products stay below 2^46,
 * so numbers hold them exactly.
 */

random::make = function(seed = 1 ~ "num")
{
    made = object();
    made.state = mth::floor(mth::abs(seed)) % 2147483646 + 1;
    made.Next = random::next;
    made.Point = random::point;

    /* The first numbers of neighbouring seeds are alike. */
    for (k = 0; k < 3; k++)
        made.Next();
    return made;
};

random::next = function(self ~ "object", low = 0 ~ "num", high = 1 ~ "num")
{
    self.state = self.state * 16807 % 2147483647;
    return low + (high - low) * ((self.state - 1) / 2147483646);
};

random::point = function(self ~ "object", low ~ "vec3", high ~ "vec3")
{
    x = self.Next(low.x, high.x);
    y = self.Next(low.y, high.y);
    return vec3(x, y, self.Next(low.z, high.z));
};
