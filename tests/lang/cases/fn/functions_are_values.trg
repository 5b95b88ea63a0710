f = function(g, x) { return g(g(x)); }; print(f(function(n) { return n * 3; }, 2));   //= 18
