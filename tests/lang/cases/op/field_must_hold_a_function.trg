v = object(); v.operator+ = 5; x = v + 1;   //! E416@36
