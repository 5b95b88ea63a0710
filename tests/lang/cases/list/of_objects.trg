l = [object()]; l[0].x = 5; print(l[0].x, l);   //= 5 [object]
