f = function() { return #vec3(1).x + #mth::max(1, 2); }; print(f());   //= 3
