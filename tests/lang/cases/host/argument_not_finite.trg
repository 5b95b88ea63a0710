s = sphere(vec3(0), 1e308 * 10);   //! E503@5: argument 2
