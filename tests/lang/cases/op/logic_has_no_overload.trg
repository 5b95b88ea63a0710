v = object(); v.operator! = function(a) { return 0; }; print(v && 1, v || 0);   //= 1 1
