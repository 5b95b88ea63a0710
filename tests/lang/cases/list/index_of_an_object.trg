o = object(); o[0] = 1;   //! E440@15
