switch (1) { default: print("default"); break; case 1: print(1); }   //= 1
