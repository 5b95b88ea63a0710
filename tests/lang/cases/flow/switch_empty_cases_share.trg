switch (2) { case 1: case 2: case 3: print("few"); break; default: print("many"); }   //= few
