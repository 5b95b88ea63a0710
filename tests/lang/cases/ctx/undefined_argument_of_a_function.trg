f = function(x) { return isdef(x); }; print(f(u)); if (0) u = 1;   //= 0
