v = object(); v.operator* = function(a, b) { return a; }; print(vec3(1) * v);   //= vec3(1, 1, 1)
