l = dir_light(vec3(1), vec3(-1, 0, 0));   //! E505@5: colour
