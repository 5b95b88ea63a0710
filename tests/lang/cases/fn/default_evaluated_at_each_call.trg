n = 0; next = function() { #n++; return #n; };
f = function(a = #next()) { return a; };
print(f(), f(), f(100), n);   //= 1 2 100 2
