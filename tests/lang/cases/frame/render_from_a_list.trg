//@ frames 1
Scene = scene(); l = [function() { #Scene.Render(); return "shown"; }]; print(l[0]());   //= shown
