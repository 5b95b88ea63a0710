for (i = 0; i < 6; i += 2) print(i); print("i", i);
//= 0
//= 2
//= 4
//= i 6
