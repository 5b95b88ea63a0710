include("\\\\server\\share\\a.trg");   //! E510@9
