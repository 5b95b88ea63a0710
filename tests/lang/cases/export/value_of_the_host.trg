//@ set radius = 4
export radius = 3; print(radius);   //= 4
