if (vec3(0)) print("vec3"); if (object()) print("object"); if (print) print("function");
//= vec3
//= object
//= function
