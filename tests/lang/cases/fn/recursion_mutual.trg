even = function(n) { if (n == 0) return 1; return #odd(n - 1); };
odd = function(n) { if (n == 0) return 0; return #even(n - 1); };
print(even(10), odd(10));   //= 1 0
