f = function() { export n = 1; };   //! E230@18
