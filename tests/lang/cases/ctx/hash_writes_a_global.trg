f = function() { #x = 5; }; f(); print(x);   //= 5
