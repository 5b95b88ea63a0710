f = function(a, b = 10) { return a + b; }; print(f(1), f(1, 2));   //= 11 3
