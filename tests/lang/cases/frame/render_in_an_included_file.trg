//@ frames 2
include("a.trg"); include("b.trg");
print("end");   //= end
//@ file a.trg
scene().Render();
//@ file b.trg
scene().Render();
