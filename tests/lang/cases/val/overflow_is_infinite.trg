x = 1e308 * 10; print(x, -x, x > 1e308);   //= inf -inf 1
