l = []; print(l, len(l));   //= [] 0
