x = "f" + print;   //! E410@5
