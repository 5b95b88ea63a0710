a = material::gold(); b = material::gold(); print(a == b);   //= 0
