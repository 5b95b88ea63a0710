o = object(); o.f = function(self, a) { };
o.f();   //! E432@1: 'a'
