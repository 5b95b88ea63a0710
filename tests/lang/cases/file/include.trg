include("a.trg"); print(x);   //= 1
//@ file a.trg
x = 1;
