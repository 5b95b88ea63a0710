a = object(); a.operator+ = function(x, y) { return 3; }; b = copy(a); print(b + 1);   //= 3
