f = function() { include("a.trg"); };   //! E214@18
