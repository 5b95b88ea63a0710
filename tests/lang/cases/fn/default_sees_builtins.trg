f = function(a = vec3(1)) { return a.x; }; print(f());   //= 1
