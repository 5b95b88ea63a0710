for (i = 3; i = 0;) { } print(i);   //? L801@13
//= 0
