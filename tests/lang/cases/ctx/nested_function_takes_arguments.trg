f = function() { n = 1; g = function(n) { return n + 1; }; return g(n); }; print(f());   //= 2
