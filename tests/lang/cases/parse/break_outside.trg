x = 1; break;   //! E216@8
