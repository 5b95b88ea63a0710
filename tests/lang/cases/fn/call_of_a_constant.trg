x = mth::PI();   //! E430@5: num
