print((a = 4) + 1, a);   //= 5 4
