//@ limit max_steps = 1000
for (;;) x = 1;   //! E601@1: raise the limit
