//@ set name = red ball
export name = "x"; print(name);   //= red ball
