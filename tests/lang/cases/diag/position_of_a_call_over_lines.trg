s = sphere(vec3(0),   //! E504@5
           -1);
