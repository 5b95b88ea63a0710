for (i = 0; i < 3; i++) { switch (1) { case 1: switch (i) { case 1: continue; } } print(i); }
//= 0
//= 2
