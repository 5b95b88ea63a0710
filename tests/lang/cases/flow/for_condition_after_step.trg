f = function(i) { print("c" + i); return i < 1; }; for (i = 0; f(i); i++) print("b" + i);
//= c0
//= b0
//= c1
