switch (1) { default: break; default: break; }   //! E212@30
