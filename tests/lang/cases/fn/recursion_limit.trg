f = function(n) { if (n == 0) return 0; return 1 + #f(n - 1); };   //! E607@5: 'f'
f(200);
