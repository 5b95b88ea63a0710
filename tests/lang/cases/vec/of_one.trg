print(vec3(2));   //= vec3(2, 2, 2)
