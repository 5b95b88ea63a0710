i = 1e308 * 10; n = i - i;
print(n < 1, n > 1, n <= n, n >= n, n != n);   //= 0 0 0 0 1
