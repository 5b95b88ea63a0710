f = function(x) { print(x); return x; };
print(f(1) < f(2) < f(3));
//= 1
//= 2
//= 3
//= 1
