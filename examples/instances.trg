/* Instances: a thousand spheres in a cube of 10 x 10 x 10. Copy() shares the mesh, so they cost one. */
Scene = scene();
Scene.Add(plane(vec3(0, 1, 0), -0.5, material::silver()));
ball = sphere(vec3(0), 0.38, material::white_plastic());

for (x = 0; x < 10; x++)
{
    skin = material::white_plastic();
    skin.Color(vec3(0.9, 0.1, 0.05) * (1 - x / 9) + vec3(0.05, 0.2, 0.9) * (x / 9));
    for (y = 0; y < 10; y++)
        for (z = 0; z < 10; z++)
        {
            piece = ball.Copy();
            piece.Move(vec3(x - 4.5, y, z - 4.5));
            piece.Material(skin);
            Scene.Add(piece);
        }
}

Scene.Add(dir_light(vec3(-5, 8, 9), vec3(1, 1, 1)));
Scene.CamSet(800, 600, vec3(12, 13, 16), vec3(0, 4, 0), vec3(0, 1, 0));
Scene.Render();
