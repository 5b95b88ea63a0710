h = function(x) { return 10 / x; };   //! E401@26
g = function(x) { return #h(x); };    //< h@26
f = function() { return #g(0); };     //< g@25
f();                                  //< f@1
