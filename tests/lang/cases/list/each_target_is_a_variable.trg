for (o.x in [1]) { }   //! E201@9
