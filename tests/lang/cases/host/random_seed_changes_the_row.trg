a = mth::rand(); std::seed(1); print(a == mth::rand());   //= 0
