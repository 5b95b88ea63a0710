f = function() { return 1 };     //! E201@26
