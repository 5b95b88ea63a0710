print(mth::dot(vec3(1, 2, 3), vec3(1)), mth::cross(vec3(1, 0, 0), vec3(0, 1, 0)), mth::length(vec3(3, 4, 0)), mth::normalize(vec3(0, 5, 0)));
//= 6 vec3(0, 0, 1) 5 vec3(0, 1, 0)
