print("shown"); // print("hidden");
//= shown
