switch (9) { case 1: print(1); break; default: print("default"); }   //= default
