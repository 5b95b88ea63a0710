s = plane(vec3(0), 1);   //! E508@5
