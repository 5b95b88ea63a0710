f = function(x) { return x; }; print(f(a = 2), a);   //= 2 2
