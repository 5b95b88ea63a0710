if (0) print("0"); if (-0.0) print("-0"); if (0.1) print("0.1"); if (-1) print("-1");
//= 0.1
//= -1
