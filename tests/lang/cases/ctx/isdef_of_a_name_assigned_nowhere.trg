print(isdef(nowhere));   //! E302@13
