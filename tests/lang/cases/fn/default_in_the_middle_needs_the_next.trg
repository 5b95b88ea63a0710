f = function(a = 1, b) { return a + b; };   //! E432@21: 'b'
f();
