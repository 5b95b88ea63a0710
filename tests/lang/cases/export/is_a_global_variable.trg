export radius = 3; f = function() { return #radius + 1; }; print(radius, f());   //= 3 4
