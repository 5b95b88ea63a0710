size = 3;
f = function(a = size) { return a; };   //! E301@18: #size
