v = object(); v . operator + = function(a, b) { return 8; }; print(v + 1);   //= 8
