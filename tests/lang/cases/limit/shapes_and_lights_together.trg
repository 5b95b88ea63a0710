//@ limit max_shapes = 3
a = sphere(vec3(0), 1); b = dir_light(vec3(1), vec3(1)); c = a.Copy();
d = b.Copy();   //! E610@5: 3
