a = vec3(1); b = a; b += vec3(1); print(a, b);   //= vec3(1, 1, 1) vec3(2, 2, 2)
