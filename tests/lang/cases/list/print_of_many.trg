l = []; for (i = 0; i < 150; i++) l.append(0);
print(l[99], len(l));   //= 0 150
