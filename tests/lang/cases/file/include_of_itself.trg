include("main.trg");   //! E320@9: main.trg
//@ file other.trg
x = 1;
