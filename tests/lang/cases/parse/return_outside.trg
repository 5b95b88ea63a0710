return 5;   //! E218@1
