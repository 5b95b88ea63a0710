f = function(a ~ "num") { return a; };   //! E434@14: must be num, not str
f("x");   //< f@1
