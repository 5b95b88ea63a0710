a = [1]; b = a; b.append(2); print(a, a == b, [1] == [1]);   //= [1, 2] 1 0
