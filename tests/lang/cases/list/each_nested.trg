for (a in [1, 2]) for (b in ["x", "y"]) print(b + a);
//= x1
//= y1
//= x2
//= y2
