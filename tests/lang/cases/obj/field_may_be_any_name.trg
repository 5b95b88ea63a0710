o.print = 1; o.vec3 = 2; o.self = 3; print(o.print + o.vec3 + o.self);   //= 6
