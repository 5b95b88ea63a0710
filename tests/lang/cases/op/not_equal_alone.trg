v = object(); v.operator!= = function(a, b) { return 1; }; print(v != v, v == v);   //= 1 1
