v = object();
v.operator+ = function(a, b) { return "+"; }; v.operator- = function(a, b) { return "-"; };
v.operator* = function(a, b) { return "*"; }; v.operator/ = function(a, b) { return "/"; };
v.operator% = function(a, b) { return "%"; };
print(v + 1, v - 1, v * 1, v / 1, v % 1);   //= + - * / %
