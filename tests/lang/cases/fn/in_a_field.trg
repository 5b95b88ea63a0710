o = object(); o.f = function(x) { return x * 2; }; print(o.f(4));   //= 8
