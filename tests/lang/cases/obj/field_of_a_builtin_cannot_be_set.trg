f = function() { sphere.x = 1; };   //! E424@18
f();
