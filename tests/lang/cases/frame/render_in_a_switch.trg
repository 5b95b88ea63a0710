//@ frames 3
Scene = scene(); f = function(n) { #Scene.Render(); return n; };
switch (f(2)) { case f(1): print("one"); break; case f(2): print("two"); break; case f(3): }   //= two
