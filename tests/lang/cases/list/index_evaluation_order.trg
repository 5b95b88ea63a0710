f = function(x) { print(x); return x; }; l = [1, 2, 3];
l[f(1)] = f(2); print(l);
//= 2
//= 1
//= [1, 2, 3]
