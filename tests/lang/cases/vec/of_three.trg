v = vec3(1, 2, 3); print(v, v.x, v.y, v.z);   //= vec3(1, 2, 3) 1 2 3
