o = object(); o.f = function(self) { return 1; };
g = o.f; g();   //! E432@10: 'self'
