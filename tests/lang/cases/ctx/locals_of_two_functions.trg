f = function() { n = 1; return n; }; g = function() { n = 2; #f(); return n; }; print(g());   //= 2
