f = function() { return; }; print(isdef(f()));   //= 0
