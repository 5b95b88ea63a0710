include("C:/a.trg");   //! E510@9
