print(0 / 5);   //= 0
