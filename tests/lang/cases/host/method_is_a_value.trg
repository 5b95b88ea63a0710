Scene = scene(); add = Scene.Add; add(sphere(vec3(0), 1)); print(typeof(add)); Scene.Render();   //= function
//& shapes.count = 1
