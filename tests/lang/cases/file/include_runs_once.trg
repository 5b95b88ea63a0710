include("a.trg"); include("a.trg");
//@ file a.trg
print("once");   //= once
