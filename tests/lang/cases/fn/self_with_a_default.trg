o = object(); o.m = function(self = 5) { return typeof(self); }; print(o.m());   //= object
