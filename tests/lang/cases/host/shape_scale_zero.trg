s = sphere(vec3(0), 1).Scale(0);   //! E508@5
