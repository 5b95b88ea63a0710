include("lib/a.trg"); print(where);   //= top
//@ file lib/a.trg
include("b.trg");
//@ file b.trg
where = "top";
