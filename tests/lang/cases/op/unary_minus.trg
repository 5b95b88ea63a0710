v = object(); v.operator- = function(a, b) { return a; }; print(-v);   //= 0
