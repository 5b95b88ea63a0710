v = object(); v.operator+=function(a, b) { return 9; }; print(v + 1);   //= 9
