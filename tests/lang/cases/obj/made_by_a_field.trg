p.x = 1; p.y = 2; print(p.x + p.y, typeof(p));   //= 3 object
