f = function() {
    n = 1;
    g = function() { return n; };   //! E303@29: argument
    return g();
};
