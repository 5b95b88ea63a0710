x = 2; for (i = 0; i < 2000; i++) x *= x; print(x);   //= inf
