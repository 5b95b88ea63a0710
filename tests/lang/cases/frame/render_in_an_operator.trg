Scene = scene(); v = object(); v.operator+ = function(a, b) { #Scene.Render(); return 1; };
x = v + 1;   //! E415@5
