v = object();
v.operator< = function(a, b) { return 11; }; v.operator> = function(a, b) { return 12; };
v.operator<= = function(a, b) { return 13; }; v.operator>= = function(a, b) { return 14; };
v.operator== = function(a, b) { return 15; }; v.operator!= = function(a, b) { return 16; };
print(v < 1, v > 1, v <= 1, v >= 1, v == 1, v != 1);   //= 1 1 1 1 1 1
