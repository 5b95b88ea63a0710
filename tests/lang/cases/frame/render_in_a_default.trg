//@ frames 1
Scene = scene(); f = function(a = #Scene.Render()) { return isdef(a); }; print(f());   //= 0
