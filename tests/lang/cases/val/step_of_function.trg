f = function() { }; f--;   //! E413@21: --
