x = len(u); if (0) u = 1;   //! E507@5
