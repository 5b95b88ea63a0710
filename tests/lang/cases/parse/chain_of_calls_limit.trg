//@ let CALLS = "()" * 101
f = function() { return #f; }; x = f${CALLS};   //! E222@239: 100
