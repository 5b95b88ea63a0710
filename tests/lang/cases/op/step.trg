v = object(); v.operator+ = function(a, b) { return b; }; v++; print(v);   //= 1
