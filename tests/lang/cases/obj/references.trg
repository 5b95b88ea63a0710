a.n = 1; b = a; b.n = 2; print(a.n, a == b);   //= 2 1
