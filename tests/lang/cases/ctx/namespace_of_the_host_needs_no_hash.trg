f = function() { return material::gold(); }; print(f());   //= material gold
