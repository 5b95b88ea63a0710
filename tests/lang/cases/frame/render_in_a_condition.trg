//@ frames 3
Scene = scene(); f = function(n) { #Scene.Render(); return n; };
if (f(0)) print("no"); else if (f(1)) print("yes"); while (f(0)) { }   //= yes
