f = function(a = 5 ~ "str") { };   //! E434@14
f();
