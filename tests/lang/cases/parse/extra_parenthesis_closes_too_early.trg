print(mth::max(1), mth::min(2, 3)));   //! E202@35: 1:17
