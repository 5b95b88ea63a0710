print(u == u, u == "", u == vec3(0));   //= 1 0 0
if (0) u = 1;
