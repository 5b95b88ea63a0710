x = "o" + object();   //! E410@5
