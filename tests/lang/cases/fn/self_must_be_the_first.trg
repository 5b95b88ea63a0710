o = object(); o.f = function(a, self) { return a + self; }; print(o.f(1, 2));   //= 3
