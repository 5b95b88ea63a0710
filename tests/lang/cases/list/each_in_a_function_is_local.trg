f = function(l) { s = 0; for (x in l) s += x; return s; }; print(f([1, 2, 3])); x = 1;   //= 6
