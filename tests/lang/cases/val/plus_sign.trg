print(+3, +vec3(1));   //= 3 vec3(1, 1, 1)
