n = 1; f = function(n) { n = n + 1; return n; }; print(f(5), n);   //= 6 1
