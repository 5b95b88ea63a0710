a = "x"; b = a; b += "y"; print(a, b);   //= x xy
