my::size = 5; my::deep::size = 6; size = 7; print(my::size, my::deep::size, size);   //= 5 6 7
