l = [1, 2]; x = l[0.5];   //! E441@19: mth::floor
