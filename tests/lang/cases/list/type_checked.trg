f = function(l ~ "list") { };   //! E434@14: list
f(5);
