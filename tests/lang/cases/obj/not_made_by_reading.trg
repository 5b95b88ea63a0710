x = p.q; p = object();   //! E422@5
