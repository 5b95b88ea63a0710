Scene = scene(); print(isdef(Scene.Render()));   //= 0
