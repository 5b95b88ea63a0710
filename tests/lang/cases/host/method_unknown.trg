Scene = scene();
Scene.add(sphere(vec3(0), 1));   //! E421@1: Add
