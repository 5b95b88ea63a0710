s = sphere(vec3(0));   //! E506@5: sphere(
