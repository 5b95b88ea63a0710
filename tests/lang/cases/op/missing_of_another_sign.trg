v = object(); v.operator+ = function(a, b) { return 1; };
x = v - 1;   //! E410@5: object - num
