//@ set radius = inf
export radius = 3;   //! E521@8
