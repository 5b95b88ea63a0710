//@ let CALLS = "()" * 99
f = function() { return #f; }; x = f${CALLS}; print(typeof(x));   //= function
