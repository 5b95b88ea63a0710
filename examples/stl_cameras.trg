/* Cameras: the same yard seen by an orbit, a dolly and a flight through gates, 48 frames each.
   Written with stl/cameras.trg. */
include("stl/cameras.trg");
include("stl/arrange.trg");
include("stl/shapes/rod.trg");

Scene = scene();
Scene.Background(vec3(0.65, 0.75, 0.9));
Scene.Add(plane(vec3(0, 1, 0), 0, material::pbr(vec3(0.45, 0.42, 0.38), 0, 0.5)));
Scene.Add(sphere(vec3(0, 1.5, 0), 1.5, material::polished_gold()));
Scene.Add(dir_light(vec3(-3, 6, 4), vec3(1.3, 1.25, 1.15)));

/* Gates along the way of the flight: two posts and a bar. */
way = arrange::ring(6, 8);
number = 0;
for (place in way)
{
    colour = mth::mix(vec3(0.7, 0.04, 0.03), vec3(0.03, 0.15, 0.6), number / 5);
    mtl = material::pbr(colour, 0, 0.8);
    out = mth::normalize(place);
    inner = place - out * 1.2;
    outer = place + out * 1.2;
    top = vec3(0, 2.6, 0);
    Scene.Add(shapes::rod(inner, inner + top, 0.15, mtl));
    Scene.Add(shapes::rod(outer, outer + top, 0.15, mtl));
    Scene.Add(shapes::rod(inner + top - out * 0.4, outer + top + out * 0.4, 0.2, mtl));
    way[number] = place + vec3(0, 1.4, 0);
    number++;
}

frames = 48;
for (k = 0; k < frames; k++)
{
    cameras::shoot(Scene, cameras::orbit(k / frames, vec3(0, 1, 0), 15, 6), 960, 540, 40);
    Scene.Render();
}
for (k = 0; k < frames; k++)
{
    t = cameras::ease(k / frames);
    cameras::shoot(Scene, cameras::dolly(t, vec3(-12, 2, 14), vec3(5, 2, 6), vec3(0, 1.5, 0)), 960, 540, 40);
    Scene.Render();
}
for (k = 0; k < frames; k++)
{
    cameras::shoot(Scene, cameras::fly(k / frames, way, 1), 960, 540, 60);
    Scene.Render();
}
