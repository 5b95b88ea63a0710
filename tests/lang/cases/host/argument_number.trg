s = sphere(vec3(0), "big");   //! E502@5: argument 2 ('radius')
