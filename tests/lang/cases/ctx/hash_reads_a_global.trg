radius = 2; f = function() { return #radius; }; print(f());   //= 2
