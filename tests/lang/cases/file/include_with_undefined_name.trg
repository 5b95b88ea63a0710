include("a.trg");
//@ file a.trg
x = nowhere;   //! E302@5
