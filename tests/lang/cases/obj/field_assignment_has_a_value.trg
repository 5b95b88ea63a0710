print((o.n = 4) + 1, o.n);   //= 5 4
