include("b.trg"); print(x);   //= 1
//@ file a.trg
x = 1;
//@ link b.trg -> a.trg
