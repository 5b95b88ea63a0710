include("http://example.org/a.trg");   //! E510@9
