switch (1) { case 1 x = 1; case 2: y = ; break; z = 1; }   //! E201@20 //! E205@40
