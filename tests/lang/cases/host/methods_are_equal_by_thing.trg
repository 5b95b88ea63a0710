a = sphere(vec3(0), 1); b = sphere(vec3(0), 1); print(a.Move == a.Move, a.Move == b.Move);   //= 1 0
