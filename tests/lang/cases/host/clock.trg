//@ option fps = 25
//@ option frames = 2
Scene = scene();
print(std::frame(), std::fps(), std::time(), std::frames()); Scene.Render();
//= 1 25 0.04 2
print(std::frame(), std::time()); Scene.Render();
//= 2 0.08
