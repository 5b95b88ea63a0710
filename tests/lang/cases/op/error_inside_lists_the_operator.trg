v = object(); v.operator+ = function(a, b) { return 1 / 0; };   //! E401@53
x = v + 1;   //< operator+@5
