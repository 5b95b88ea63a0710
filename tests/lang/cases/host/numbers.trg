print(mth::floor(-1.5), mth::ceil(1.2), mth::abs(-2), mth::sign(-3), mth::min(3, 1, 2), mth::max(3, 1), mth::clamp(5, 0, 1));
//= -2 2 2 -1 1 3 1
