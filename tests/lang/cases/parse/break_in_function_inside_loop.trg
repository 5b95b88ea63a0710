while (0) { f = function() { break; }; }   //! E216@30
