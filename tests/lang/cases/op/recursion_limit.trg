v = object(); v.operator+ = function(a, b) { return a + b; };   //! E608@53: 50
x = v + 1;
