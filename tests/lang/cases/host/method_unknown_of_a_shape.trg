s = sphere(vec3(0), 1); s.Mve(vec3(1));   //! E421@25: Move
