f = function(a ~ "num") { };   //! E434@14: not undef
f(u); if (0) u = 1;
