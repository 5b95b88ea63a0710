i = 0; while (i++ < 4) { if (i == 2) continue; print(i); }
//= 1
//= 3
//= 4
