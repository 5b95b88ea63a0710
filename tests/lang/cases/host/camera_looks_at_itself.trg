Scene = scene();
Scene.CamSet(64, 36, vec3(1), vec3(1), vec3(0, 1, 0));   //! E508@1
