x = sfere(vec3(0), 1);   //! E302@5: sphere
