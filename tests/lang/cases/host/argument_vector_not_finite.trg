s = sphere(vec3(1) * (1e308 * 10), 1);   //! E503@5: argument 1
