x = mth::mix(0, vec3(1), 0.5);   //! E508@5
