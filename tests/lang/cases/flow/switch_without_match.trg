switch (9) { case 1: print(1); } print("end");   //= end
