export on = 1 ~ "flag"; export tint = vec3(1, 0, 0) ~ "colour"; export n = 2 ~ "num";
//& exports.on.type = "flag"
//& exports.tint.type = "colour"
//& exports.n.type = "num"
