x = 1; f = function() { #x += 4; #x++; }; f(); print(x);   //= 6
