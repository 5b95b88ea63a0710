for (x in [1, "a", vec3(1)]) print(x);
//= 1
//= a
//= vec3(1, 1, 1)
