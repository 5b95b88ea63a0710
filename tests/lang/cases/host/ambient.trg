Scene = scene(); Scene.Ambient(vec3(0.5)); Scene.Render();
//& ambient = (0.5, 0.5, 0.5)
