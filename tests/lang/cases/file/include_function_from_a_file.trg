include("a.trg"); print(double(4));   //= 8
//@ file a.trg
double = function(x) { return x * 2; };
