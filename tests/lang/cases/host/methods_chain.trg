s = sphere(vec3(0), 1).Move(vec3(1)).Scale(2).Name("ball"); print(s);   //= sphere
