f = function(a::b) { };   //! E201@15
