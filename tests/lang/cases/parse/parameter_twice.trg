f = function(a, b, a) { };   //! E208@20
