print(typeof(1 < 2), (1 < 2) + 1);   //= num 2
