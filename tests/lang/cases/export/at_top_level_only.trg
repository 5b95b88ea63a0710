if (1) { export n = 1; }   //! E230@10
