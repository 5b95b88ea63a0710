f = function() { }; f.g = function(self) { return 1; };
f.g();   //! E432@1: 'self'
