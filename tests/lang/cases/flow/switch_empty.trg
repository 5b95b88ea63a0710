switch (1) { } print("end");   //= end
