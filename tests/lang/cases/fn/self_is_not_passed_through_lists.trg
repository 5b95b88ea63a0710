f = function(self) { return typeof(self); }; l = [f]; print(l[0](5));   //= num
