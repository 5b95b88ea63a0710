while (0) print("never"); print("end");   //= end
