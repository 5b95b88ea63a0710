while (a = 0) { } print("end");   //? L801@8
//= end
