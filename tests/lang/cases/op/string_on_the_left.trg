v = object(); v.operator+ = function(a, b) { return a; }; print("s" + v);   //= s
