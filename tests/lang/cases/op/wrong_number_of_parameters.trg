v = object(); v.operator+ = function(a) { };
x = v + 1;   //! E433@5
