Scene = scene(); t = texture("lib/A.png"); Scene.Background(t); Scene.Render(); print("ok");   //= ok
//@ bytes lib/a.png 00
