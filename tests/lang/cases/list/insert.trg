l = [1, 3]; l.insert(1, 2); l.insert(3, 4); l.insert(0, 0); print(l);   //= [0, 1, 2, 3, 4]
