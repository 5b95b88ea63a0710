f = function() { #x = 7; }; g = function() { return #x; }; f(); print(g());   //= 7
