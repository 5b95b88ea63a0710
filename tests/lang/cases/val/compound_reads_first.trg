x = 5; x += x = 3; print(x);   //= 8
