f = function() { print("list"); return [1, 2]; }; for (x in f()) print(x);
//= list
//= 1
//= 2
