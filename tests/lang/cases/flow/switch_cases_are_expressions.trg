n = 3; switch (6) { case n * 2: print("twice"); break; case n: print("once"); }   //= twice
