v = object(); v.operator! = function(a) { return "not"; }; print(!v, !1);   //= not 0
