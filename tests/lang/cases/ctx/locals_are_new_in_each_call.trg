f = function(first) { if (first) n = 5; return isdef(n); }; print(f(1), f(0));   //= 1 0
