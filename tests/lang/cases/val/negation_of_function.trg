f = function() { }; x = -f;   //! E413@25
