for (i = 0; i < 2; i++) { for (;;) break; print(i); }
//= 0
//= 1
