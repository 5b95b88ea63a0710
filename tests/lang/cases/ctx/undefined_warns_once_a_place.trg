for (k = 0; k < 5; k++) x = u + 1;   //? W701@29: 0 is used
print(x);   //= 1
if (0) u = 1;
