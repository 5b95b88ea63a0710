if (u) print("yes"); else print("no");   //= no
if (0) u = 1;
