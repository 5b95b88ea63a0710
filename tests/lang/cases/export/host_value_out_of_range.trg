//@ set radius = 11
export radius = 3 ~ range(0, 10); print("never");   //! E521@8: 0 .. 10
