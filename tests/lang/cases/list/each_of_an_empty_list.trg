for (x in []) print("never"); print(isdef(x));   //= 0
