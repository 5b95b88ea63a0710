f = function() { }; x = 1 + f;   //! E410@25: num + function
