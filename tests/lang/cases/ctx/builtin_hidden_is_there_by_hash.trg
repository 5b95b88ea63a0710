f = function(len) { return #len("abc") + len; }; print(f(1));   //? L802@14
//= 4
