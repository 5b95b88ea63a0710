x = 1; export n = x;   //! E330@19
