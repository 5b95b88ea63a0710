print(mth::mix(0, 10, 0.25), mth::mix(vec3(0), vec3(4), 0.5));   //= 2.5 vec3(2, 2, 2)
