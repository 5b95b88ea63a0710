v = object(); v.operator* = function(a, b) { return typeof(a) + typeof(b); }; print(2 * v, v * 2);
//= numobject objectnum
