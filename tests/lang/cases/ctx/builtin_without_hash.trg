f = function() { return mth::max(vec3(1).x, 2); }; print(f());   //= 2
