o = object(); o.n += 1;   //! E421@15
