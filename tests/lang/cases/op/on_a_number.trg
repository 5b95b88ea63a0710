x = 5; x.operator+ = function(a, b) { };   //! E420@8
