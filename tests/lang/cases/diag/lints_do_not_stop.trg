if (a = 1) print("ran");   //? L801@5
//= ran
