export sphere = 5;   //! E310@8
