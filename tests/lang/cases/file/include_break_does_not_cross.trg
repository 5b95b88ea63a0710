while (1) { x = 1; break; }
include("a.trg");
//@ file a.trg
break;   //! E216@1
