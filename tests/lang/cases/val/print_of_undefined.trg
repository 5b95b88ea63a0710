print(u); if (0) u = 1;   //= undef
