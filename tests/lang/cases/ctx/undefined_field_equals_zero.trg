o.f = u; print(0 == o.f); if (0) u = 1;   //? W701@21
//= 1
