f = function(a = b, b = 1) { return isdef(a); }; print(f());   //= 0
