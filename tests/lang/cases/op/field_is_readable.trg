v = object(); v.operator+ = function(a, b) { return a + b; }; print(v.operator+(2, 3));   //= 5
