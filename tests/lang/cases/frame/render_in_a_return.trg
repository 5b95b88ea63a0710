//@ frames 1
Scene = scene(); f = function() { #Scene.Render(); return 7; }; g = function() { return #f(); };
print(g());   //= 7
