f = function(x) { print(x); return x; };
y = mth::max(f(2), f(1), f(3));
//= 2
//= 1
//= 3
