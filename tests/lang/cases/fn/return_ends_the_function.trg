f = function() { return 1; print("never"); }; print(f());   //= 1
