l = spot_light(vec3(0), vec3(0, -1, 0), 60, 40, vec3(1));   //! E508@5
