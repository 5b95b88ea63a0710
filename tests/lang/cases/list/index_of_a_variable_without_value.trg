x = u[0]; if (0) u = 1;   //! E446@5: value
