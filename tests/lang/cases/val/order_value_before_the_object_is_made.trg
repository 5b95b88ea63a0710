p.x = isdef(p); print(p.x);   //= 0
