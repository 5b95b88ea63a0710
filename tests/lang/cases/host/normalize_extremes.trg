print(mth::normalize(vec3(0, 1e-320, 0)), mth::normalize(vec3(0, 0, -1.7e308)));   //= vec3(0, 1, 0) vec3(0, 0, -1)
print(mth::length(mth::normalize(vec3(1.7e308))) > 0.999);   //= 1
