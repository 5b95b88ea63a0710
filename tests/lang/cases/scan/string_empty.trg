print("", len(""));   //=  0
