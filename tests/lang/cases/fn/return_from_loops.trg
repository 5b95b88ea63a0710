f = function() { while (1) { for (;;) { switch (1) { case 1: return "out"; } } } }; print(f());   //= out
