v = object(); v.operator== = function(a, b) { return "yes"; }; if (v == 1) print("true"); print(v == 1);
//= true
//= 1
