x = true;   //! E107@5: write 1
