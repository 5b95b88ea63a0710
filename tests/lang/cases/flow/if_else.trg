if (1) print("a"); else print("b"); if (0) print("c"); else print("d");
//= a
//= d
