for (x in u) print(x); if (0) u = 1;   //! E444@11
