print(mth::floor(mth::rand() * 1000), mth::floor(mth::rand() * 1000));   //= 280 724
