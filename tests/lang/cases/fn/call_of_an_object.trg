o = object(); o();   //! E430@15: object
