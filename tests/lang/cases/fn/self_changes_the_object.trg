o = object(); o.n = 1; o.inc = function(self) { self.n++; return self; };
o.inc(); o.inc().inc(); print(o.n);   //= 4
