x = mth::sqrt(-1);   //! E504@5
