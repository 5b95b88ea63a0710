x = false;   //! E107@5: write 0
