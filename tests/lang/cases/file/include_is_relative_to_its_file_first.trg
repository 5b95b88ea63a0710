include("lib/a.trg"); print(where);   //= lib
//@ file lib/a.trg
include("b.trg");
//@ file lib/b.trg
where = "lib";
//@ file b.trg
where = "top";
