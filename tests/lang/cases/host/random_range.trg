ok = 1; for (i = 0; i < 1000; i++) { x = mth::rand(2, 5); if (x < 2 || x >= 5) ok = 0; } print(ok);   //= 1
