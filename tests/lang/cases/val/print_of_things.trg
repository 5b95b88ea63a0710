print(scene(), sphere(vec3(0), 1), material::gold(), enviroment(0, 1.5), dir_light(vec3(1), vec3(1)));
//= scene sphere material gold enviroment(0, 1.5) dir_light
