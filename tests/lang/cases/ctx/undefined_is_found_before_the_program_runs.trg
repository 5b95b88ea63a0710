print("never");
x = nowhere;   //! E302@5
