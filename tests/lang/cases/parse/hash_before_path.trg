a::b = 3; f = function() { return #a::b; }; print(f());   //= 3
