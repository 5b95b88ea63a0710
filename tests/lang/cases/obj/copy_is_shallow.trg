a.n = 1; a.o = object(); b = copy(a); b.n = 2; b.o.x = 5;
print(a.n, b.n, a.o.x, a == b);   //= 1 2 5 0
