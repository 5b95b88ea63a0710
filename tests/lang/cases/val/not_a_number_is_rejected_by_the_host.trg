x = 1e308 * 10; s = sphere(vec3(0), x - x);   //! E503@21: argument 2
