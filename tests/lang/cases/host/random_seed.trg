a = mth::rand(); b = mth::rand(); std::seed(0); print(a == mth::rand(), b == mth::rand(), a == b);   //= 1 1 0
