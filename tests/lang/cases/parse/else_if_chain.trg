x = 3;
if (x == 1) print("one"); else if (x == 3) print("three"); else print("other");
//= three
