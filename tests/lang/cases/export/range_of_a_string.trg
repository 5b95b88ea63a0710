export s = "a" ~ range(0, 1);   //! E334@18
