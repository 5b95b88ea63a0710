s = "a"; s += "b"; s += 1; print(s);   //= ab1
