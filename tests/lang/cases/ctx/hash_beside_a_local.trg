x = 1; f = function() { x = 2; return x * 10 + #x; }; print(f());   //= 21
