//@ files f{i}.trg * 9 = "include(\"f{j}.trg\");"
include("f1.trg");
//@ file f8.trg
include("f9.trg");   //! E322@9: 8
