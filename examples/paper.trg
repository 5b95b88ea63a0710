/* The program of the paper that TRG comes from, with its one typo mended: a bracket too many after the
   file name of the model. The cow is not to be had: the program warns and shows a placeholder in its
   place. The cones stand in a row, as written: their angle never passes through sin and cos. */
include("stl\\rt\\trg_raytrace.trg");

std::setrndmode("cuda");

Scene = scene();

BuildFence = function( s = 15 ~ "num", gr = 6 ~ "num", a = #vec3(0) ~ "vec3" )
{
    #Scene.Add(#fence(a + #vec3(0, 1, 0), s, 2, gr, #material::blue_plastic()));
    i = 0;
    an = #mth::Degree2Radian(90);
    P1 = #mth::Degree2Radian(360) / gr;
    while (i < gr)
    {
        #Scene.Add(#conus(#vec3(an * s, 1, s), 1, 3, material::red_plastic()));
        an += P1;
        i++;
    }
};

t = texture("chess.g24", 2);
a = material::white_plastic();
a.SetTexture(t, 1);
Scene.Add(tor(vec3(0, 0.75, 1), 0.75, 5, material::green_plastic()));
BuildFence(15, 6);

Scene.Add(model("BIN\\MODELS\\cow.g3dm", enviroment(0, 1), material::red_plastic()));

Scene.Add(plane(vec3(0, 1, 0), 0, material::silver()));

p = dir_light(vec3(-7, 5, 8), vec3(1, 1, 1));
Scene.Add(p);

while (1)
{
    Scene.CamSet(1920, 1080, vec3(30, 10, 30 * mth::sin(i / 180 * 3.14)),
                vec3(0, 0, 0), vec3(0, 1, 0));
    Scene.Render();
    i += 3;
}
