Scene = scene();
Scene.CamSet(16385, 1, vec3(1), vec3(0), vec3(0, 1, 0));   //! E504@1: 1 .. 16384
