m = material::gold(); e = enviroment(0, 1);
a = sphere(vec3(0), 1, m, e); b = sphere(vec3(0), 1, e, m); c = sphere(vec3(0), 1, m); print("ok");   //= ok
