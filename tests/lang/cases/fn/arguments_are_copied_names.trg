f = function(o) { o = 5; }; p = 1; f(p); print(p);   //= 1
