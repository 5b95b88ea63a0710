l = [1]; for (x in l) { print(x); if (x < 3) l.append(x + 1); }
//= 1
//= 2
//= 3
