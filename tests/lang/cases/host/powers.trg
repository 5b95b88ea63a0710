print(mth::pow(2, 10), mth::sqrt(9), mth::exp(0), mth::log(1), mth::pow(10, 400));   //= 1024 3 1 0 inf
