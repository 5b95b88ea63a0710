f = function() { print("value"); return 1; };
g = function() { print("target"); return #o; };
o = object();
g().x = f();
//= value
//= target
