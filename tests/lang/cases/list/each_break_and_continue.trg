for (x in [1, 2, 3, 4]) { if (x == 2) continue; if (x == 4) break; print(x); }
//= 1
//= 3
