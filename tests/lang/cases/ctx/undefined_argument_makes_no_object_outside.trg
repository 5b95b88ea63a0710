f = function(a) { a.x = 1; return a.x; }; print(f(u), isdef(u)); if (0) u = 1;   //= 1 0
