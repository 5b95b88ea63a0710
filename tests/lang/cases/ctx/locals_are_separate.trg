x = 1; f = function() { x = 2; return x; }; print(f(), x);   //= 2 1
