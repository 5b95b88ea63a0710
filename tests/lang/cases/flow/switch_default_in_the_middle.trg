switch (9) { case 1: print(1); default: print(0); case 2: print(2); }   //? L803@14 //? L803@32
//= 0
//= 2
