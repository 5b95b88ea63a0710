a = 1; b = a++ * 2 + a; c = a++ + ++a; print(a, b, c);   //= 4 4 6
