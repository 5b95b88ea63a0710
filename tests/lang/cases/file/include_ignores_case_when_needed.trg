include("LIB/A.trg"); print(x);   //= 1
//@ file lib/a.trg
x = 1;
