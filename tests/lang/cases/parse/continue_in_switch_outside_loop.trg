switch (2) { default: continue; }   //! E217@23
