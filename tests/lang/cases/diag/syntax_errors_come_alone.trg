x = nowhere;
y = ;   //! E205@5
