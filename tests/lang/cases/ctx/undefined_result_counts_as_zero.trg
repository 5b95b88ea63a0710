f = function() { }; print(f() + 1);   //? W701@27
//= 1
