/* Functions and loops: a spiral stair and a tree that calls itself, turned for twelve frames.
   A function sees its parameters and its own variables; #name reaches the global ones. */
Scene = scene();
Scene.Background(vec3(0.8, 0.7, 0.6));
Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));

Stair = function(steps = 24 ~ "num", radius = 3 ~ "num")
{
    for (k = 0; k < steps; k++)
    {
        angle = #mth::Degree2Radian(k * 20);
        foot = #vec3(radius * #mth::cos(angle), k * 0.25, radius * #mth::sin(angle));
        switch (k % 3)
        {
            case 0: m = #material::ruby(); break;
            case 1: m = #material::jade(); break;
            default: m = #material::turquoise();
        }
        #Scene.Add(#cylinder(foot, 0.7, 0.2, m));
    }
};

Tree = function(foot ~ "vec3", size ~ "num", depth ~ "num")
{
    top = foot + #vec3(0, size, 0);
    #Scene.Add(#conus(foot, size * 0.2, size * 1.3, #material::bronze()));
    if (depth == 0)
        return #Scene.Add(#sphere(top, size * 0.5, #material::green_plastic()));
    for (k = 0; k < 3; k++)
    {
        angle = #mth::Degree2Radian(k * 120 + depth * 40);
        branch = #vec3(#mth::cos(angle), 0, #mth::sin(angle)) * size * 0.3;
        #Tree(top + branch, size * 0.6, depth - 1);
    }
};

Stair();
Tree(vec3(0), 2.2, 3);
Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 0.97, 0.9)));

for (frame = 0; frame < 12; frame++)
{
    angle = mth::Degree2Radian(30 * frame);
    Scene.CamSet(800, 600, vec3(10 * mth::sin(angle), 5, 10 * mth::cos(angle)),
        vec3(0, 2.6, 0), vec3(0, 1, 0));
    Scene.Render();
}
