export radius = 3 ~ range(0, 10);
//& exports.radius.type = "num"
//& exports.radius.high = 10
