s = sphere(vec3(0), 1); s.size = 2;   //! E424@25: 'size'
