l = [u]; print(l[0] + 1, l); if (0) u = 1;   //? W701@16
//= 1 [undef]
