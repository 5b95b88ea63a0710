print("n = " + 5, 5 + " apples", "x" + 0.5, "y" + 2 / 2);   //= n = 5 5 apples x0.5 y1
