f = function() { return function(x) { return x + 1; }; }; print(f()(5));   //= 6
