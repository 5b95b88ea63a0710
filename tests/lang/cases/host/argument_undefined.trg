s = sphere(vec3(0), r); if (0) r = 1;   //! E507@5: 'radius'
