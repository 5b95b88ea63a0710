f = function(l) { l.append(1); }; a = []; f(a); print(len(a));   //= 1
