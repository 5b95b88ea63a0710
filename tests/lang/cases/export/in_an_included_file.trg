//@ set size = 5
include("a.trg"); print(size);   //= 5
//@ file a.trg
export size = 2;
