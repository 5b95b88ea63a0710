x = $a;   //! E100@5: reserved
