a = u; print(isdef(a), typeof(a)); if (0) u = 1;   //= 0 undef
