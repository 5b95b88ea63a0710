export n = 1 + 2;   //! E330@12
