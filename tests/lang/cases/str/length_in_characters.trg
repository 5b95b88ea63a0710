print(len("abc"), len("длина"), len("a\n"));   //= 3 5 2
