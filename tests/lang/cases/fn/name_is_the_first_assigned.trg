f = g = function() { return 1 / 0; };   //! E401@29
f();   //< g@1
