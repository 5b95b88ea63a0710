x = 1; /* no end       //! E106@8
