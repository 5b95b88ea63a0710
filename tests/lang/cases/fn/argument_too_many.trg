f = function(a, b = 1) { };
f(1, 2, 3);   //! E433@1: 1 to 2 arguments, 3 given
