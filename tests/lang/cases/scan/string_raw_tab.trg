print("a	b");   //= a	b
