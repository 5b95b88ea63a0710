v = object(); v.operator+ = function(a, b) { return b * 2; }; v += 4; print(v);   //= 8
