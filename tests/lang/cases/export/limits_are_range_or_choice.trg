export n = 1 ~ limits(1, 2);   //! E231@16
