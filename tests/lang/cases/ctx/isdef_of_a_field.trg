o.f = 1; print(isdef(o.f), isdef(o.g), isdef(u.f)); if (0) u = 1;   //= 1 0 0
