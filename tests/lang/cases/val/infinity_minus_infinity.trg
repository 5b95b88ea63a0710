x = 1e308 * 10; y = x - x; print(y, y == y);   //= nan 0
