v = vec3(1); v += vec3(1); v *= 3; v -= vec3(1, 0, 0); v /= 2; print(v);   //= vec3(2.5, 3, 3)
