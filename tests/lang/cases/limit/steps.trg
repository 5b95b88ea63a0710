//@ limit max_steps = 1000
while (1) { }   //! E601@1: 1000 steps
