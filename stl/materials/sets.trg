/*
 * sets - the table of library materials, by number.
 *
 * The rows are those of Silicon Graphics' teapots program (1994) and blue plastic. A number beyond the
 * last starts again at the first; fractions are dropped.
 *
 *   materials::gem(n)        emerald jade obsidian pearl ruby turquoise
 *   materials::metal(n)      brass bronze polished_bronze chrome copper polished_copper gold
 *                            polished_gold pewter silver polished_silver
 *   materials::plastic(n)    black blue cyan green red white yellow
 *   materials::rubber(n)     black cyan green red white yellow
 *   materials::teapot(n)     gems 0-5, metals 6-16, plastics 17-23, rubbers 24-29
 *   materials::name(n)       the name of materials::teapot(n), as after material::
 *
 * Use:
 *
 *   include("stl/materials/sets.trg");
 *   Scene = scene();
 *   for (n = 0; n < 30; n++)
 *   {
 *       Scene.Add(sphere(vec3(n % 10 * 2.4 - 10.8, 1, 3 - mth::floor(n / 10) * 3), 1, materials::teapot(n)));
 *       print(n, materials::name(n));
 *   }
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.CamSet(960, 400, vec3(0, 9, 20), vec3(0, 0.5, 0.5), vec3(0, 1, 0), 37);
 *   Scene.Render();
 */

materials::gem = function(n = 0 ~ "num")
{
    switch (mth::floor(n) % 6)
    {
        case 0: return material::emerald();
        case 1: return material::jade();
        case 2: return material::obsidian();
        case 3: return material::pearl();
        case 4: return material::ruby();
    }
    return material::turquoise();
};

materials::metal = function(n = 0 ~ "num")
{
    switch (mth::floor(n) % 11)
    {
        case 0: return material::brass();
        case 1: return material::bronze();
        case 2: return material::polished_bronze();
        case 3: return material::chrome();
        case 4: return material::copper();
        case 5: return material::polished_copper();
        case 6: return material::gold();
        case 7: return material::polished_gold();
        case 8: return material::pewter();
        case 9: return material::silver();
    }
    return material::polished_silver();
};

materials::plastic = function(n = 0 ~ "num")
{
    switch (mth::floor(n) % 7)
    {
        case 0: return material::black_plastic();
        case 1: return material::blue_plastic();
        case 2: return material::cyan_plastic();
        case 3: return material::green_plastic();
        case 4: return material::red_plastic();
        case 5: return material::white_plastic();
    }
    return material::yellow_plastic();
};

materials::rubber = function(n = 0 ~ "num")
{
    switch (mth::floor(n) % 6)
    {
        case 0: return material::black_rubber();
        case 1: return material::cyan_rubber();
        case 2: return material::green_rubber();
        case 3: return material::red_rubber();
        case 4: return material::white_rubber();
    }
    return material::yellow_rubber();
};

materials::teapot = function(n = 0 ~ "num")
{
    row = mth::floor(n) % 30;
    if (row < 6) return materials::gem(row);
    if (row < 17) return materials::metal(row - 6);
    if (row < 24) return materials::plastic(row - 17);
    return materials::rubber(row - 24);
};

materials::name = function(n = 0 ~ "num")
{
    row = mth::floor(n) % 30;
    rubbers = ["black", "cyan", "green", "red", "white", "yellow"];
    if (row >= 24) return rubbers[row - 24] + "_rubber";
    plastics = ["black", "blue", "cyan", "green", "red", "white", "yellow"];
    if (row >= 17) return plastics[row - 17] + "_plastic";
    others = ["emerald", "jade", "obsidian", "pearl", "ruby", "turquoise", "brass", "bronze", "polished_bronze",
        "chrome", "copper", "polished_copper", "gold", "polished_gold", "pewter", "silver",
        "polished_silver"];
    return others[row];
};
