s = sphere(vec3(0), 1).Rotate(vec3(0), 90);   //! E508@5
