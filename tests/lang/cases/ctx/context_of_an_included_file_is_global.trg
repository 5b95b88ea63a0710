include("a.trg");
print(x);   //= 5
//@ file a.trg
x = 5;
