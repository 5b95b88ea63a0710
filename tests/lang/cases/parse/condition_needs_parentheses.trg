if 1 print(1);   //! E201@3: '('
