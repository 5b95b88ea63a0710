f = function() { x = 1; }; print(isdef(f()));   //= 0
