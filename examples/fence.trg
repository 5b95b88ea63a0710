/* The paper's scene with what its authors meant: the cones stand at the fence's corners, the chess texture lies
   on a stage, and the project's own elephant stands where the cow stood. One Render() is one frame of an
   endless camera ride. (paper.trg is the program as printed.) */
include("stl\\rt\\trg_raytrace.trg");

Scene = scene();

BuildFence = function( s = 15 ~ "num", gr = 6 ~ "num", a = #vec3(0) ~ "vec3" )
{
    #Scene.Add(#fence(a + #vec3(0, 1, 0), s, 2, gr, #material::blue_plastic()));
    i = 0;
    P1 = #mth::Degree2Radian(360) / gr;
    an = #mth::Degree2Radian(90) + P1 / 2;
    corner = s / #mth::cos(P1 / 2);
    while (i < gr)
    {
        post = a + #vec3(#mth::cos(an), 0, #mth::sin(an)) * corner;
        #Scene.Add(#conus(post, 1, 3, material::red_plastic()));
        an += P1;
        i++;
    }
};

t = texture("chess.g24", 2);
a = material::white_plastic();
a.SetTexture(t, 1);
Scene.Add(box(vec3(-8, 0, -7), vec3(8, 0.05, 9), a));
Scene.Add(tor(vec3(0, 0.75, 1), 0.75, 5, material::green_plastic()));
BuildFence(15, 6);

Scene.Add(model("models\\elephant.g3dm", enviroment(0, 1), material::red_plastic()));

Scene.Add(plane(vec3(0, 1, 0), 0, material::silver()));

p = dir_light(vec3(-7, 5, 8), vec3(1, 1, 1));
Scene.Add(p);

i = 30;
while (1)
{
    Scene.CamSet(960, 540, vec3(30, 10, 30 * mth::sin(i / 180 * 3.14)),
                vec3(0, 4, 0), vec3(0, 1, 0));
    Scene.Render();
    i += 3;
}
