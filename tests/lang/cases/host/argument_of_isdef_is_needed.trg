x = isdef();   //! E506@5
