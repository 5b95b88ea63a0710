a = 1; b = a + 1; a = 10; print(b);   //= 2
