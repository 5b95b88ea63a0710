include = 5; print(include);   //= 5
