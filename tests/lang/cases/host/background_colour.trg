Scene = scene(); Scene.Background(vec3(0.1, 0.2, 0.3)); Scene.Render();
//& background = (0.1, 0.2, 0.3)
