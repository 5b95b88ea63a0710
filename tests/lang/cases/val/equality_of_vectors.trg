print(vec3(1, 2, 3) == vec3(1, 2, 3), vec3(1) == vec3(2), vec3(1) != vec3(2));   //= 1 0 1
