f = function() { #print = 1; };   //! E310@18
