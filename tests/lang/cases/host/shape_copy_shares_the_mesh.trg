Scene = scene(); a = sphere(vec3(0), 1); Scene.Add(a.Copy().Move(vec3(1))); Scene.Add(a); Scene.Render();
//& shapes.0.mesh_key = "sphere@1:22#1"
//& shapes.1.mesh_key = "sphere@1:22#1"
