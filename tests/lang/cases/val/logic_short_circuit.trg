f = function() { print("called"); return 1; };
print(0 && f(), 1 || f());   //= 0 1
