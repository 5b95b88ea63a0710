//@ limit max_steps = 1000
f = function(n) { if (n == 0) return; #f(n - 1); #f(n - 1); };   //! E601@5: 1000 steps
f(30);
