o.n = 10; o.n += 5; o.n /= 3; print(o.n);   //= 5
