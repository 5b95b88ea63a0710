m = material::unobtainium();   //! E302@5
