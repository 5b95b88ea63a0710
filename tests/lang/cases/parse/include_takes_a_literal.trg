n = "a.trg"; include(n);   //! E215@22
