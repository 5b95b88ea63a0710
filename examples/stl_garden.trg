/* A garden: walls of brick on two sides, a fence with posts round a tree, sun and lawn. Written with
   stl/shapes.trg, stl/arrange.trg and what the paper's program includes, stl/rt/trg_raytrace.trg. */
include("stl/rt/trg_raytrace.trg");
include("stl/shapes.trg");
include("stl/arrange.trg");

Scene = scene();
stl::daylight(Scene);
stl::stage(Scene, material::pbr(vec3(0.1, 0.22, 0.04), 0, 0.35));

/* Walls: bricks of 50 cm keep their number small. */
brick = vec3(0.5, 0.16, 0.25);
shapes::brick_wall(13, 2.2, brick).Move(vec3(0, 0, -6)).AddTo(Scene);
side = shapes::brick_wall(9, 2.2, brick, vec3(0.42, 0.11, 0.06), 2);
side.Rotate(vec3(0, 1, 0), 90).Move(vec3(-6.5, 0, -1.5)).AddTo(Scene);
cap = material::pbr(vec3(0.55, 0.52, 0.47), 0, 0.3);
Scene.Add(box(vec3(-6.7, 2.1, -6.2), vec3(6.6, 2.25, -5.8), cap));
Scene.Add(box(vec3(-6.7, 2.1, -5.8), vec3(-6.3, 2.25, 3.1), cap));

/* The tree stands in a fence of ten panels. */
white = material::white_plastic();
white.Color(vec3(0.8, 0.8, 0.77));
shapes::fence(2.6, 0.9, 10, white, material::polished_bronze()).AddTo(Scene);
Scene.Add(cylinder(vec3(0), 0.28, 2, material::pbr(vec3(0.16, 0.08, 0.04), 0, 0.2)));
leaves = material::pbr(vec3(0.05, 0.2, 0.03), 0, 0.4);
for (place in arrange::scatter(60, vec3(-1.4, 1.9, -1.4), vec3(1.4, 4.1, 1.4), 5, 0.35))
    if (mth::length(place - vec3(0, 3, 0)) < 1.45)
        Scene.Add(sphere(place, 0.45, leaves));

/* Flowers outside the fence only. */
petals = [material::pbr(vec3(0.8, 0.1, 0.1)), material::pbr(vec3(0.9, 0.6, 0.05)), material::pbr(vec3(0.6, 0.2, 0.7))];
number = 0;
for (place in arrange::scatter(260, vec3(-6, 0, -5.5), vec3(7, 0, 4.5), 3, 0.25))
    if (mth::length(place) > 3.1)
    {
        Scene.Add(cylinder(place, 0.015, 0.22, leaves));
        Scene.Add(sphere(place + vec3(0, 0.24, 0), 0.08, petals[number % 3]));
        number++;
    }

Scene.CamSet(960, 540, vec3(6, 7, 11.5), vec3(-0.5, 1.2, -0.6), vec3(0, 1, 0), 32);
Scene.Render();
