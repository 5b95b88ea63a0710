//@ set n = 3
export n = 4 ~ range(0, 10, 2);   //! E521@8: step 2
