Scene = scene(); Scene.Render();
//& camera = None
