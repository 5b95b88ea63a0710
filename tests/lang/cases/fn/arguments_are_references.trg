f = function(o) { o.n = 5; }; p = object(); f(p); print(p.n);   //= 5
