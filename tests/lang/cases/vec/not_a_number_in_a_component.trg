v = vec3(1e308) * 10; n = v - v;
print(n == n, n != n, v == v);   //= 0 1 1
