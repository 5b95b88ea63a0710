o = object(); o.n++;   //! E421@15
