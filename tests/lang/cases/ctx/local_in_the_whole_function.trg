x = 1; f = function() { a = isdef(x); x = 2; return a; }; print(f());   //= 0
