o = object(); o.p = object(); o.p.x = 4; print(o.p.x);   //= 4
