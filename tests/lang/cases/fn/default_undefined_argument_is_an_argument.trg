f = function(a = 5) { return isdef(a); }; print(f(u)); if (0) u = 1;   //= 0
