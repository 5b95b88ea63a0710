f = function() { for (#x in [1, 2]) { } }; f(); print(x); if (0) x = 0;   //= 2
