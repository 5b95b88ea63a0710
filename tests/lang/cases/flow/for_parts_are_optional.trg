i = 0; for (;;) { if (i == 3) break; i++; } print(i);   //= 3
