//@ set radius = wide
export radius = 3;   //! E521@8: 'radius'
