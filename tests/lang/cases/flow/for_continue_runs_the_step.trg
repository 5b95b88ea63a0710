for (i = 0; i < 4; i++) { if (i == 1) continue; print(i); }
//= 0
//= 2
//= 3
