export n = 0 ~ range(-1, 1, 1e-300);   //! E334@16
