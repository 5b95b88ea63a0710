include("a.trg");   //! E510@9
//@ file ../outside.trg
print("outside");
//@ link a.trg -> ../outside.trg
