f = function() { if (0) n = 1; return n + 1; }; print(f());   //? W701@39
//= 1
