f = function(a, b) { };
f(1);   //! E432@1: 'b'
