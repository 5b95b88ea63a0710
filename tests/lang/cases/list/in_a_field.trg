o = object(); o.l = [1]; o.l[0] = 2; o.l.append(3); print(o.l);   //= [2, 3]
