if (0) if (1) print(1); else print(2);
print("end");   //= end
