include("a.trg");
y = ;   //! E205@5
//@ file a.trg
x = ;   //! E205@5
