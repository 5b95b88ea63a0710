//@ limit max_seconds = 0.05
spin = function() { for (;;) n = 1; };   //! E602@21
spin();
