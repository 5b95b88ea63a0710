f = function() { return 1; };
g = function() { return f(); };   //! E301@25: #f
