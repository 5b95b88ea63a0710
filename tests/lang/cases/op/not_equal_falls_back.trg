v = object(); v.operator== = function(a, b) { return 1; }; print(v != 1, v == 1);   //= 0 1
