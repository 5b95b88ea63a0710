f = function() { return #nowhere; };   //! E302@25
