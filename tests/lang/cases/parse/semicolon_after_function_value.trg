f = function() { }      //! E201@19
x = 1;
