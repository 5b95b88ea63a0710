v = vec3(1) / vec3(2);   //! E410@5: vec3 / vec3
