x = u < "a"; if (0) u = 1;   //! E412@5: undef < str
