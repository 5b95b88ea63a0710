print(mth::noise(vec3(1.5, 2, 3)) == mth::noise(vec3(1.5, 2, 3)), mth::noise(0.5) <= 1, mth::noise(0.5) >= -1);   //= 1 1 1
