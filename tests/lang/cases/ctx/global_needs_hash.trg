radius = 2;
f = function() { return radius; };   //! E301@25: #radius
