f = function() { print("subject"); return 2; }; switch (f()) { case 1: case 2: case 3: }   //= subject
