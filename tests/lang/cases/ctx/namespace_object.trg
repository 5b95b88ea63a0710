a::b.c = 5; print(a::b, a::b.c);   //= object(c = 5) 5
