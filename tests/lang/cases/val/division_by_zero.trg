x = 0;
y = 10 / x;   //! E401@5: zero
