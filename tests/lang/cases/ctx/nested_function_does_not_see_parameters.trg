f = function(a) { return function() { return a; }; };   //! E303@46
