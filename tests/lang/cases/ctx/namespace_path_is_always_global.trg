my::size = 5; f = function() { my::made = my::size + 1; return my::size; }; print(f(), my::made);   //= 5 6
