x = one;   //! E302@5
y = two;   //! E302@5
