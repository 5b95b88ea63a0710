operator+ = 1;   //! E205@1
