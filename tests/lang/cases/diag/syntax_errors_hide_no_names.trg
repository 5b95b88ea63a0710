x = nowhere;   //! E302@5
y = ;          //! E205@5
