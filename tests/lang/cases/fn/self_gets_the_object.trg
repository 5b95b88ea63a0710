o = object(); o.n = 3; o.f = function(self, x) { return self.n + x; }; print(o.f(4));   //= 7
