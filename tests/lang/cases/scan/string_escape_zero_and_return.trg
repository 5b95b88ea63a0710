print(len("\0\r"));   //= 2
