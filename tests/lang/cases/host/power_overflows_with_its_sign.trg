print(mth::pow(-10, 401), mth::pow(-10, 400), mth::exp(800), mth::exp(709.7) < 1.7e308);   //= -inf inf inf 1
