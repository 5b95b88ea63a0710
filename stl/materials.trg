/*
 * materials - sets of library materials by number, and finishes made from them.
 *
 * material::gold() and its 29 sisters, glass, mirror, emission and pbr are built in. This file orders
 * the table into sets and adds what is often wanted. Every call gives a fresh material that may be
 * edited. Colours are linear RGB in 0..1; smoothness is 0 (dull) to 1 (polished); temperatures kelvin.
 *
 *   materials::teapot(n)      all 30 rows of the table: 6 gems, 11 metals, 7 plastics, 6 rubbers
 *   materials::gem(n)  metal(n)  plastic(n)  rubber(n)      one set; n starts at 0 and wraps round
 *   materials::name(n)        the name of row n of the table
 *   materials::water()  ice()  diamond()  frosted_glass(smoothness)  tinted_glass(colour)
 *   materials::brushed(mtl, smoothness)    any material, less polished
 *   materials::tinted_mirror(colour)  aluminium()  iron()  nickel()  titanium()
 *   materials::ceramic(colour)  lacquer(colour)  clay(colour)  chalk(colour)
 *   materials::neon(colour, strength)    a tube that shines
 *   materials::lamp(kelvin, strength)    the white of a lamp: candle 1900, bulb 2700, noon 5500
 *
 * Use:
 *
 *   include("stl/materials.trg");
 *   Scene = scene();
 *   for (n = 0; n < 11; n++)
 *       Scene.Add(sphere(vec3(n * 2.2 - 11, 1, 0), 1, materials::metal(n)));
 *   Scene.Add(sphere(vec3(-3, 1, 4), 1, materials::tinted_glass(vec3(0.9, 0.5, 0.4))));
 *   Scene.Add(sphere(vec3(3, 1, 4), 1, materials::lamp(2700, 2)));
 *   Scene.Add(plane(vec3(0, 1, 0), 0, materials::chalk()));
 *   Scene.CamSet(640, 360, vec3(0, 6, 16), vec3(0, 0.5, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/materials/sets.trg");
include("stl/materials/finishes.trg");
