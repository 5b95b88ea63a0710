switch (1) { case 1: print(1); case 2: print(2); break; case 3: print(3); }   //? L803@14: break
//= 1
//= 2
