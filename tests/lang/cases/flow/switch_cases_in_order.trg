f = function(x) { print(x); return x; }; switch (2) { case f(1): case f(2): case f(3): }
//= 1
//= 2
