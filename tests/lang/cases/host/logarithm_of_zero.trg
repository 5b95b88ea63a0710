x = mth::log(0);   //! E504@5
