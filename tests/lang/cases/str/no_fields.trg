x = "abc".length;   //! E420@5: length
