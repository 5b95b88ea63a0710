mth::mine = 1;   //! E311@1: mth::
