v = object(); v.operator- = function(a, b) { return a; }; print(5 - v);   //= 5
