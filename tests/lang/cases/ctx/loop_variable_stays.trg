for (i = 0; i < 3; i++) last = i; print(i, last);   //= 3 2
