/*
 * shapes - everything in stl/shapes/ at once: fence, stairs, gear, spring, wall, rod.
 *
 * Each function of shapes:: but rod returns a group (see stl/group.trg): built round the origin,
 * standing on y = 0, not yet in the scene. Lengths are metres, angles degrees. The parameters stand at
 * the head of each file.
 *
 *   shapes::fence(radius, height, count, panel, post)       a ring of panels between posts
 *   shapes::stairs(steps, width, rise, run, mtl)            a straight flight along -Z
 *   shapes::spiral_stairs(steps, radius, rise, degrees, mtl)    round a column, with a rail
 *   shapes::gear(teeth, module, thickness, mtl, hub)        a spur gear; its axis is Y
 *   shapes::spring(turns, radius, height, wire, mtl)        a helix round Y
 *   shapes::brick_wall(length, height, brick, colour, seed) along X, in running bond
 *   shapes::rod(from, to, radius, mtl)                      one cylinder between two points
 *
 * Use:
 *
 *   include("stl/shapes.trg");
 *   Scene = scene();
 *   shapes::fence(6, 1.2, 12).AddTo(Scene);
 *   shapes::spiral_stairs(20, 1.5).AddTo(Scene);
 *   shapes::gear(18, 0.2).Rotate(vec3(1, 0, 0), 90).Move(vec3(-4, 2, 0)).AddTo(Scene);
 *   shapes::spring(5, 0.6, 2).Move(vec3(3.5, 0, 1)).AddTo(Scene);
 *   Scene.Add(plane(vec3(0, 1, 0), 0, material::white_rubber()));
 *   Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1, 1, 1)));
 *   Scene.CamSet(640, 360, vec3(0, 6, 14), vec3(0, 1.5, 0), vec3(0, 1, 0));
 *   Scene.Render();
 */
include("stl/shapes/rod.trg");
include("stl/shapes/fence.trg");
include("stl/shapes/stairs.trg");
include("stl/shapes/gear.trg");
include("stl/shapes/spring.trg");
include("stl/shapes/wall.trg");
