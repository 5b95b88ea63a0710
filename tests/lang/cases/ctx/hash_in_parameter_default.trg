size = 3; f = function(a = #size) { return a; }; print(f());   //= 3
