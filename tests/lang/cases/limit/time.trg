//@ limit max_seconds = 0.05
while (1) { }   //! E602@1: 0.05 seconds
