mk = function() { return function() { }; };
f = mk(); g = mk(); f.n = 1; print(isdef(f.n), isdef(g.n), f == g);   //= 1 0 0
