print(function(a) { return a * 2; }(21));   //= 42
