p = vec3(1); p.x = 5;   //! E423@14: make a new one
