v = object(); v.operator+ = function(a, b) { return "sum"; }; print(v + 1);   //= sum
