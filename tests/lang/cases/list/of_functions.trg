l = [function() { return "called"; }]; print(l[0]());   //= called
