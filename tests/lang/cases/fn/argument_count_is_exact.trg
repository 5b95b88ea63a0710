f = function() { };
f(1);   //! E433@1: 0 arguments, 1 given
