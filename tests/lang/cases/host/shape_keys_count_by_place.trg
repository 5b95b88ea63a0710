Scene = scene(); for (i = 0; i < 2; i++) Scene.Add(box(vec3(0), vec3(1))); Scene.Render();
//& shapes.0.key = "box@1:52#1"
//& shapes.1.key = "box@1:52#2"
