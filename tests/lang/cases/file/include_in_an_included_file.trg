include("lib/a.trg"); print(x + y);   //= 3
//@ file lib/a.trg
include("b.trg"); x = 1;
//@ file lib/b.trg
y = 2;
