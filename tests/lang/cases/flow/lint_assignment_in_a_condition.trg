if (a = 3) print(a);   //? L801@5: ==
//= 3
