mth::sin.x = 3;   //! E424@1
