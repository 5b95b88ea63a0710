v = object(); v.operator< = function(a, b) { print(typeof(a)); return 1; }; x = 5 < v; x = v < 5;
//= num
//= object
