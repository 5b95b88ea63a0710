f = function(a, b) { return a - b; }; print(f(5, 3));   //= 2
