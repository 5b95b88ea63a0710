l = [1, 2, 3]; print(l.remove(1), l);   //= 2 [1, 3]
