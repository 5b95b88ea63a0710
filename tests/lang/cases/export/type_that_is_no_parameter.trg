export n = 2 ~ "shape";   //! E333@16: shape
