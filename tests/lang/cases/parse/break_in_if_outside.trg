if (1) { break; }   //! E216@10
