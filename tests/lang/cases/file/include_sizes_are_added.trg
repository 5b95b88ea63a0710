//@ let LONG = "x" * 131100
/* ${LONG} */ include("a.trg");
//@ file a.trg
/* ${LONG} */ x = 1;   //! E109@1: 262144
