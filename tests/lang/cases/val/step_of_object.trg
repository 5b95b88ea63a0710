o = object(); o++;   //! E413@15: ++
