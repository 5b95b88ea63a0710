x = u + 1; print(x); if (0) u = 1;   //? W701@5
//= 1
