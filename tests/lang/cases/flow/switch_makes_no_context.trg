switch (1) { case 1: x = 5; } print(x);   //= 5
