x = u[0]; if (0) u = 1;   //! E440@5: undef
