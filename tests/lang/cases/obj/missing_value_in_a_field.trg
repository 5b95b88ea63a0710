o = object(); o.p = u; o.p.x = 5; if (0) u = 1;   //! E422@24: 'p'
