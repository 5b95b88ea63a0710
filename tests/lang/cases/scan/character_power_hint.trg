x = 2 ^ 3;   //! E100@7: mth::pow
