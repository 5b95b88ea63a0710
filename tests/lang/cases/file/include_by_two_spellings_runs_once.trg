include("a.trg"); include("./A.TRG");
//@ file a.trg
print("once");   //= once
