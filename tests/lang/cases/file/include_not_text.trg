include("a.trg");   //! E512@9
//@ bytes a.trg ff fe 00
