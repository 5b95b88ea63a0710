//@ frames 1
Scene = scene(); Scene.Render();
x = 1 / 0;   //! E401@5
