a = object(); b = object(); a.b = b; b.a = a; print(a.b.a == a, a);   //= 1 object(b = object)
