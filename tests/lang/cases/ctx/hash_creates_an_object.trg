f = function() { #p.x = 1; }; f(); print(p.x); if (0) p = 0;   //= 1
