export n = 2 ~ "nums";   //! E333@16: num
