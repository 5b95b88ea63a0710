Scene = scene(); s = Scene.Add(sphere(vec3(0), 1)); s.Material(material::glass(1.4)); Scene.Render();
//& shapes.0.material.ior = 1.4
//& shapes.0.material.transmission = 1
