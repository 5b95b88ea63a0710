include("lib/a.trg"); Scene.Render();
//& shapes.0.key = "sphere@lib/a.trg:1:28#1"
//@ file lib/a.trg
Scene = scene(); Scene.Add(sphere(vec3(0), 1));
