l = point_light(vec3(0), vec3(1), 0, 0, 0);   //! E508@5
