v = vec3(vec3(1));   //! E502@5
