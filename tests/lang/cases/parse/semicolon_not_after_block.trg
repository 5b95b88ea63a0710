if (1) { print(1); } while (0) { } print(2);
//= 1
//= 2
