print(1e-400);   //= 0
