include("a.trg"); include("./A.trg"); include("sub\\..\\a.trg");   //! E510@47
//@ file a.trg
x = 1;
