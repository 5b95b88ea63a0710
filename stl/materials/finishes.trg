/*
 * finishes - glass, metal, paint and light, ready made.
 *
 * Colours are linear RGB in 0..1; smoothness is 0 (dull) to 1 (polished). Every call gives a fresh
 * material that may be edited.
 *
 *   materials::water()  ice()  diamond()               clear, with their index of refraction
 *   materials::frosted_glass(smoothness = 0.7)         clear, with a rough face
 *   materials::tinted_glass(colour)                    what passes takes the colour
 *   materials::brushed(mtl, smoothness = 0.6)          the material given, less polished
 *   materials::tinted_mirror(colour)
 *   materials::aluminium()  iron()  nickel()  titanium()    polished; use brushed() to dull them
 *   materials::ceramic(colour)  lacquer(colour)  clay(colour)  chalk(colour)
 *   materials::neon(colour, strength = 4)              shines in the colour
 *   materials::lamp(kelvin = 2700, strength = 4)       shines in the white of a lamp
 *   materials::kelvin(temperature)                     that white as a colour, its largest part 1
 *
 * Use:
 *
 *   include("stl/materials/finishes.trg");
 *   Scene = scene();
 *   Scene.Add(sphere(vec3(-3, 1, 0), 1, materials::frosted_glass(0.6)));
 *   Scene.Add(sphere(vec3(0, 1, 0), 1, materials::lacquer(vec3(0.6, 0.02, 0.02))));
 *   Scene.Add(sphere(vec3(3, 1, 0), 1, materials::brushed(materials::titanium(), 0.5)));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), materials::kelvin(5500)));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, materials::clay()));
 *   Scene.CamSet(640, 360, vec3(0, 3, 8), vec3(0, 0.8, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */

materials::water = function() { return material::glass(1.333).Name("water"); };

materials::ice = function() { return material::glass(1.31).Smoothness(0.85).Name("ice"); };

materials::diamond = function() { return material::glass(2.417).Name("diamond"); };

materials::frosted_glass = function(smoothness = 0.7 ~ "num")
{
    return material::glass(1.5).Smoothness(smoothness).Name("frosted_glass");
};

materials::tinted_glass = function(colour = vec3(0.6, 0.9, 0.7) ~ "vec3")
{
    return material::glass(1.5).Color(colour).Name("tinted_glass");
};

materials::brushed = function(mtl ~ "material", smoothness = 0.6 ~ "num")
{
    return mtl.Smoothness(smoothness);
};

materials::tinted_mirror = function(colour = vec3(0.9, 0.75, 0.6) ~ "vec3")
{
    return material::mirror().Color(colour).Name("tinted_mirror");
};

/*
 * Reflectances of clean metals at normal incidence, from the table of S. Lagarde, "Feeding a physically
 * based shading model", 2011, rounded.
 */
materials::aluminium = function() { return material::pbr(vec3(0.913, 0.921, 0.925), 1, 0.85).Name("aluminium"); };

materials::iron = function() { return material::pbr(vec3(0.56, 0.57, 0.58), 1, 0.7).Name("iron"); };

materials::nickel = function() { return material::pbr(vec3(0.66, 0.609, 0.526), 1, 0.85).Name("nickel"); };

materials::titanium = function() { return material::pbr(vec3(0.542, 0.497, 0.449), 1, 0.8).Name("titanium"); };

materials::ceramic = function(colour = vec3(0.8, 0.78, 0.72) ~ "vec3")
{
    return material::pbr(colour, 0, 0.85).Name("ceramic");
};

materials::lacquer = function(colour = vec3(0.5, 0.02, 0.02) ~ "vec3")
{
    return material::pbr(colour, 0, 0.95).Name("lacquer");
};

materials::clay = function(colour = vec3(0.5, 0.22, 0.12) ~ "vec3")
{
    return material::pbr(colour, 0, 0.15).Name("clay");
};

materials::chalk = function(colour = vec3(0.8, 0.8, 0.78) ~ "vec3")
{
    return material::pbr(colour, 0, 0).Name("chalk");
};

materials::neon = function(colour = vec3(1, 0.2, 0.5) ~ "vec3", strength = 4 ~ "num")
{
    return material::emission(colour, strength).Name("neon");
};

materials::lamp = function(kelvin = 2700 ~ "num", strength = 4 ~ "num")
{
    return material::emission(materials::kelvin(kelvin), strength).Name("lamp");
};

/*
 * The colour of a black body between 1000 and 15000 K. Its chromaticity is the rational approximation of
 * M. Krystek, "An algorithm to calculate correlated colour temperature", Color Research and Application
 * 10, 1985; the matrix is that from CIE XYZ to linear Rec. 709.
 */
materials::kelvin = function(temperature = 6500 ~ "num")
{
    t = mth::clamp(temperature, 1000, 15000);
    u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t)
        / (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t)
        / (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    x = 3 * u / (2 * v);
    z = (2 * u - 8 * v + 4 - 3 * u - 2 * v) / (2 * v);
    colour = vec3(3.2406 * x - 1.5372 - 0.4986 * z, -0.9689 * x + 1.8758 + 0.0415 * z,
        0.0557 * x - 0.2040 + 1.0570 * z);
    bright = mth::max(colour.x, mth::max(colour.y, colour.z));
    return vec3(mth::max(0, colour.x), mth::max(0, colour.y), mth::max(0, colour.z)) / bright;
};
