v = object(); print(isdef(v.operator+)); v.operator+ = function(a, b) { }; print(isdef(v.operator+));
//= 0
//= 1
