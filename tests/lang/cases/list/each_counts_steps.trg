//@ limit max_steps = 1000
l = [1]; for (x in l) l.append(x);   //! E601@10: 1000
