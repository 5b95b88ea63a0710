x = one;     //! E302@5
f = function() { return two; };   //! E302@25
y = three;   //! E302@5
