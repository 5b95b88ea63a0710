include("a.trg");
//@ file a.trg
include("b.trg");
//@ file b.trg
include("a.trg");   //! E320@9: a.trg
