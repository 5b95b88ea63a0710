o = object(); n = 0; g = function() { #n++; return #o; };
g().x = 1; g().x += 5; g().x++; print(o.x, n);   //= 7 3
