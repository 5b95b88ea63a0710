print(isdef(5), isdef(""), isdef(vec3(0).x));   //= 1 1 1
