f = function() { #a = 10; return 1; };
a = 1; a += f(); print(a);   //= 2
