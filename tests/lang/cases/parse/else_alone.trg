else x = 1;   //! E205@1
