f = function(a ~ "str") { };   //! E434@14
f(5);
