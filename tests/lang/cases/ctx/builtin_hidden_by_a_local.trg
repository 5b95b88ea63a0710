f = function() { plane = 3; return plane; }; print(f());   //? L802@18
//= 3
