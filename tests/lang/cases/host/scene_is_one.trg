a = scene(); b = scene(); print(a == b, typeof(a));   //= 1 scene
