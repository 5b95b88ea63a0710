o = object(); o.f = function(x) { return 1 / x; };   //! E401@42
o.f(0);   //< f@1
