include("nowhere.trg");   //! E511@9: nowhere.trg
