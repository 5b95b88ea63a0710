x = 1e308 * 10; print(5 % x, -5 % x, x % 5);   //= 5 inf nan
