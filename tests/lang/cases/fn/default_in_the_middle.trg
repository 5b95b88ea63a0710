f = function(a = 1, b) { return a * 10 + b; }; print(f(2, 3));   //= 23
