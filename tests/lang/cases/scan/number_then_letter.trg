x = 12px;   //! E101@7: letter
