if ([]) print("true");   //= true
