//@ frames 1
Scene = scene(); o = object(); o.show = function(self, n) { #Scene.Render(); return n; }; print(o.show(3));   //= 3
