if (1) { include("a.trg"); }   //! E214@10
