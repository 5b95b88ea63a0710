f = function() { print("called"); return 0; };
//= called
print(1 && f());             //= 0
