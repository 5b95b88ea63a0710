p.x = 1; p.s = "t"; p.o = object();
print(p, vec3(1, 0.5, 2), print, function() { });
//= object(x = 1, s = "t", o = object) vec3(1, 0.5, 2) function function
