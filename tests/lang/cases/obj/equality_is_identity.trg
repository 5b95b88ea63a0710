a = object(); b = object(); print(a == a, a == b, a != b);   //= 1 0 1
