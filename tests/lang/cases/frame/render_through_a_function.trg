//@ frames 1
Scene = scene(); f = function() { #Scene.Render(); }; g = function() { #f(); return "back"; }; print(g());   //= back
