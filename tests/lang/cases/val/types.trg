t = texture("no.png");   //? W702@5: no.png
print(typeof(1), typeof("a"), typeof(vec3(1)), typeof(object()), typeof(print), typeof(u));
//= num str vec3 object function undef
print(typeof(scene()), typeof(sphere(vec3(0), 1)), typeof(dir_light(vec3(1), vec3(1))));
//= scene shape light
print(typeof(material::gold()), typeof(t), typeof(enviroment(0, 1)));
//= material texture medium
if (0) u = 1;
