/* first
   second */ print("after");
//= after
