//@ files f{i}.trg * 7 = "include(\"f{j}.trg\");"
include("f1.trg"); print(x);   //= 8
//@ file f8.trg
x = 8;
