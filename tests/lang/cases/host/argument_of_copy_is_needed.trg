x = copy();   //! E506@5
