f = function() { }; x = f <= f;   //! E412@25
