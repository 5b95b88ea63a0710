print(vec3(2, 4, 6) / 2);   //= vec3(1, 2, 3)
