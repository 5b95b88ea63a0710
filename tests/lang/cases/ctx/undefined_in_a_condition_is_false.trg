if (u) x = 1; else x = 2; while (u) { } print(x, !u, u || 1);   //= 2 1 1
if (0) u = 1;
