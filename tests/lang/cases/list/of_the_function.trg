print(list(1, 2), list(), [1, 2] == list(1, 2));   //= [1, 2] [] 0
