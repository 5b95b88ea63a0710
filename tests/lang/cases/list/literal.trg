l = [1, "a", vec3(1)]; print(l, len(l), typeof(l));   //= [1, "a", vec3(1, 1, 1)] 3 list
