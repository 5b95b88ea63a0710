v = object(); v.operator+ = function(a, b) { }; print(isdef(v + 1));   //= 0
