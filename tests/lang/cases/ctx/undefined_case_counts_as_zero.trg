switch (0) { case u: print("zero"); break; } if (0) u = 1;   //? W701@19
//= zero
