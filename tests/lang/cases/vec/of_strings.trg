v = vec3("1", 2, 3);   //! E502@5: argument 1
