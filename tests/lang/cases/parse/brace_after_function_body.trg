f = function() { x = 1; }; };   //! E210@28
