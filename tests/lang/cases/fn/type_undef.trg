f = function(a ~ "undef") { return "none"; }; print(f(u)); if (0) u = 1;   //= none
