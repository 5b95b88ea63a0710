export radius = 3 ~ "num" ~ range(0, 10); print(radius);   //= 3
//& exports.radius.low = 0
//& exports.radius.high = 10
