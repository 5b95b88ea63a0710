p.x = 4; f = function() { return #p.x; }; print(f());   //= 4
