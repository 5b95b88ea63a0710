export n = 3 ~ range(10, 0);   //! E334@16
