x = mth::sin(1, 2);   //! E506@5: takes 1 arguments, 2 given
