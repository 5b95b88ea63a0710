v = 1 / vec3(2);   //! E410@5: num / vec3
