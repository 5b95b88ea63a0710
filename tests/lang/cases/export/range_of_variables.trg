lo = 0; export n = 3 ~ range(lo, 10);   //! E334@24
