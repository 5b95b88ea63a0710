switch (2) { case 2: print("a"); break; case 2: print("b"); break; }   //= a
