v = object(); v.operator+ = function(a, b) { return isdef(a); }; print(u + v); if (0) u = 1;   //= 0
