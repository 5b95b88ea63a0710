x = function() { return 1 / 0; }();   //! E401@25
//< function@1:5
