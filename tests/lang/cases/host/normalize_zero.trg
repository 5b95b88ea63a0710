x = mth::normalize(vec3(0));   //! E508@5
