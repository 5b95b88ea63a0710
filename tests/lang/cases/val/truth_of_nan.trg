x = 1e308 * 10; if (x - x) print("true");   //= true
