v = object(); v.operator== = function(a, b) { return b == 2; };
switch (v) { case 1: print(1); break; case 2: print(2); break; }   //= 2
