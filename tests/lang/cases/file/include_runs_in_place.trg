print("before"); include("a.trg"); print("after");
//= before
//= inside
//= after
//@ file a.trg
print("inside");
