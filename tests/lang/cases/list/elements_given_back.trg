//@ limit max_elements = 1000
for (i = 0; i < 500; i++) l = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]; print(len(l));   //= 10
