print("a" + "b" + "");   //= ab
