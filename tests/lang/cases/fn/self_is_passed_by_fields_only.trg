f = function(self) { return self; }; print(f(5));   //= 5
