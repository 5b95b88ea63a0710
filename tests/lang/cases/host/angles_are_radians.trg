print(mth::sin(mth::PI / 2), mth::cos(0), mth::Degree2Radian(180) == mth::PI, mth::Radian2Degree(mth::PI));   //= 1 1 1 180
