f = function() { }; g = f; h = function() { }; print(f == g, f == h);   //= 1 0
