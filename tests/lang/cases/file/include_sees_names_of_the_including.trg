x = 5; include("a.trg");
//@ file a.trg
print(x);   //= 5
