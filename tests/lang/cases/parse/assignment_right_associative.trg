a = b = c = 3; print(a, b, c);   //= 3 3 3
