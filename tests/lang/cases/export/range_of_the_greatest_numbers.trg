export n = 1e308 ~ range(0, 1.7e308);
export m = 0 ~ range(-1.7e308, 1.7e308);   //! E334@16
