f = function(g ~ "function") { return g(4); }; print(f(mth::sqrt));   //= 2
