while = 5;   //! E201@6
