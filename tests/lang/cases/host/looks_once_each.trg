s = sphere(vec3(0), 1, material::gold(), material::gold());   //! E508@5: one material
