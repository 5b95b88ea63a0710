include("lib/../a.trg");   //! E510@9
//@ file a.trg
x = 1;
