switch (1) { case "1": print("str"); break; case 1: print("num"); break; }   //= num
