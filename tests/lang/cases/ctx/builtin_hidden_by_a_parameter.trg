f = function(box) { return box + 1; }; print(f(2));   //? L802@14: 'box'
//= 3
