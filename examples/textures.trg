/* Textures: one image on three shapes; the second argument of texture() repeats it that many times. */
Scene = scene();
Scene.Background(vec3(0.8, 0.72, 0.62));

board = material::white_plastic();
board.SetTexture(texture("chess.g24"), 1);

tiled = material::silver();
tiled.SetTexture(texture("chess.g24", 4), 1);

/* Slot 2 is the roughness: dark squares are polished, light ones dull. */
etched = material::polished_gold();
etched.SetTexture(texture("chess.g24", 2), 2);

Scene.Add(box(vec3(-6, -0.2, -4), vec3(6, 0, 4), tiled));
Scene.Add(box(vec3(-4.2, 0, -1.2), vec3(-1.8, 2.4, 1.2), board));
Scene.Add(sphere(vec3(0.6, 1.3, 0), 1.3, board));
Scene.Add(sphere(vec3(3.8, 1.3, 0), 1.3, etched));

Scene.Add(dir_light(vec3(-4, 7, 6), vec3(1, 1, 1)));
Scene.CamSet(960, 540, vec3(0, 4, 9), vec3(0, 0.8, 0), vec3(0, 1, 0));
Scene.Render();
