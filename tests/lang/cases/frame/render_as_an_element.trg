//@ frames 2
Scene = scene(); l = [Scene.Render(), 1, Scene.Render()]; print(len(l));   //= 3
