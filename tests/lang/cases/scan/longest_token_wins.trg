a = 1; b = a++ + 1; c = a-- -1; print(b, c, a);   //= 2 1 1
