x = -u; if (0) u = 1; print(x);   //? W701@6
//= 0
