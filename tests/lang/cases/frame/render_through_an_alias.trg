//@ frames 2
Scene = scene(); show = Scene.Render; show(); again = show; again(); print("end");   //= end
