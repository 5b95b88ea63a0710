x = u - "a"; if (0) u = 1;   //! E410@5: undef - str
