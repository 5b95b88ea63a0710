include("~/a.trg");   //! E510@9
