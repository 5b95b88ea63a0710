print(copy(5), copy("a"), copy(vec3(1)));   //= 5 a vec3(1, 1, 1)
