f = function() { return 1; }; f.count = 5; print(f.count, f());   //= 5 1
