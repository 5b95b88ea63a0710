export n = 1 ~ choice(1, 2);   //! E334@16
