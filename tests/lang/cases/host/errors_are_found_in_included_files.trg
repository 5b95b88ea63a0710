include("a.trg");
f(0);
//@ file a.trg
f = function(x) {
    return 1 / x;   //! E401@12
};
