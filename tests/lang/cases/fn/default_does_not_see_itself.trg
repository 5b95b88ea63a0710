f = function(a = a) { return isdef(a); }; print(f(), f(1));   //= 0 1
