include("lib/a.trg");
//@ file lib/a.trg
t = texture("a.png"); print("found");   //= found
//@ bytes lib/a.png 00
