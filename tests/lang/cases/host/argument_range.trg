s = sphere(vec3(0), -1);   //! E504@5: > 0
