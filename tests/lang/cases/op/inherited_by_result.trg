v = object(); v.n = 1;
v.operator+ = function(a, b) { r = object(); r.n = a.n + b.n; r.operator+ = a.operator+; return r; };
print((v + v + v).n);   //= 3
