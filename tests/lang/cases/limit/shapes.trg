//@ limit max_shapes = 100
for (;;) s = sphere(vec3(0), 1);   //! E610@14: 100
