a = object(); b = object();
a.operator+ = function(x, y) { return "a"; }; b.operator+ = function(x, y) { return "b"; };
print(a + b, b + a);   //= a b
