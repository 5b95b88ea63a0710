p.n = 1; p.n++; print(p.n++, ++p.n);   //= 2 4
