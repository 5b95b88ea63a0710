//@ let CYRILLIC = "\u0441"
s${CYRILLIC}ene = 1; s${CYRILLIC}ene = 2;   //? L804@1: scene
f = function(n) { size = n; return size; };
g = function(n) { si${CYRILLIC}e = n; return si${CYRILLIC}e; };
раdius = 1; радиус = 2;   // mixed alphabets alone are no lint
