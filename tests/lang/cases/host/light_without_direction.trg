l = dir_light(vec3(0), vec3(1));   //! E508@5: direction
