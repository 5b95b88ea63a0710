export n;   //! E201@9
