for (i = 0; i < 2; i++) { switch (i) { case 0: break; } print(i); }
//= 0
//= 1
