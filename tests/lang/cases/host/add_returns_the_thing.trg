Scene = scene(); s = Scene.Add(sphere(vec3(0), 1)); print(typeof(s));   //= shape
Scene.Render();
//& shapes.count = 1
