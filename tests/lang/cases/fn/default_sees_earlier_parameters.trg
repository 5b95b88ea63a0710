f = function(a, b = a * 2, c = a + b) { return c; }; print(f(1), f(1, 5));   //= 3 6
