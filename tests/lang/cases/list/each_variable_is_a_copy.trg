l = [1, 2]; for (x in l) x = 9; print(l);   //= [1, 2]
