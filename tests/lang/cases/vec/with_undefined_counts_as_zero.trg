v = vec3(1) * u; if (0) u = 1;   //? W701@15
print(v);   //= vec3(0, 0, 0)
