f = function(a ~ "scene", b ~ "shape", c ~ "light", d ~ "material", e ~ "medium") { return "ok"; };
print(f(scene(), sphere(vec3(0), 1), dir_light(vec3(1), vec3(1)), material::gold(), enviroment(0)));
//= ok
