export n = 4 ~ range(0, 10, 2);
//& exports.n.step = 2
