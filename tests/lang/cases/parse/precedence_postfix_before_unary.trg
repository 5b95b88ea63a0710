f = function() { return 2; }; i = 5; print(-f(), -i++, i);   //= -2 -5 6
