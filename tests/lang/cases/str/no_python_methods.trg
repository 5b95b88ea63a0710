x = "abc".upper();   //! E420@5
