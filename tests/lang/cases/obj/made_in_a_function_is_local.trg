f = function() { p.x = 1; return p; }; print(f().x);   //= 1
